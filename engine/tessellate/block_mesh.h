// SPDX-License-Identifier: Apache-2.0
// Blocks -> triangles without cracks.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "surface/surface.h"
#include "tessellate/block_plan.h"
#include "tessellate/mesh.h"

namespace luxo {

/// Every block becomes a grid of its cells; along sides where the line has other vertices than the block's
/// cells, the outer ring of cells is replaced by triangles that lead from one to the other and are no larger
/// than a cell. Evaluates on all cores; the result does not depend on how many there are. The triangles of a
/// block follow those of the block before it: `firstIndices` receives where each block's indices start, and
/// the end.
[[nodiscard]] Mesh meshOfBlocks(const Surface& surface, std::span<const double> parameters,
                                std::vector<Block> blocks, std::vector<std::size_t>* firstIndices = nullptr);

}  // namespace luxo
