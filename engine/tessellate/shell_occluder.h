// SPDX-License-Identifier: Apache-2.0
// Slabs around a surface that it spans from wall to wall, so that no ray passes through them beside it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tessellate/shell_frame.h"

namespace luxo {

struct ShellOccluder {
  std::vector<Vec3> positions;  ///< of the top's vertices, then of the bottom's
  std::vector<bool> joined;     ///< of each wall of the frame: patches go on in each other, no wall is there
  std::vector<std::uint32_t> slabs;  ///< of each patch: which of the slabs it is in
  bool proven = true;                ///< false where no direction leads out
};

/// `distances`: of each point of the frame.
/// `positions`: the shell's, which are those of vertices that no wall is near.
[[nodiscard]] ShellOccluder occluderOf(const ShellFrame& frame, std::span<const Distances> distances,
                                       std::span<const Vec3> positions, std::uint32_t patchCount);

}  // namespace luxo
