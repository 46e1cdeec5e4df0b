// SPDX-License-Identifier: Apache-2.0
// More and smaller blocks where a mesh is too coarse to carry a shell.
#pragma once

#include <span>
#include <vector>

#include "shell/shell_frame.h"
#include "surface/surface.h"
#include "tessellate/block_plan.h"

namespace luxo {

/// From so many vertices on it is worth waking all cores to move them.
inline constexpr std::size_t kPointsForAllCores = 8192;

/// Cuts blocks, or raises their segments, where triangles turn by more than `desc.mostTurn` away from the
/// direction in which a corner moves, and where moving would turn them over. What is much thinner than the
/// tolerance stays as it is. `frame` is that of the blocks. Returns whether anything changed.
[[nodiscard]] bool refineForShell(const Surface& surface, std::span<const double> parameters,
                                  const ShellDesc& desc, const ShellFrame& frame, std::vector<Block>& blocks);

}  // namespace luxo
