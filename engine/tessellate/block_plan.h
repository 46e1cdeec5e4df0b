// SPDX-License-Identifier: Apache-2.0
// Cuts patches into blocks of uniform cells: fine where the surface bends, coarse where it does not.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "surface/segments.h"
#include "surface/surface.h"
#include "tessellate/curvature_map.h"
#include "tessellate/tessellator.h"
#include "tessellate/tile.h"

namespace luxo {

/// A tile cut into segments.u x segments.v equal cells.
struct Block {
  std::uint32_t patch = 0;
  Tile tile;
  Segments segments;
  double bound = 0;   ///< proven deviation of its triangles
  bool open = false;  ///< the formula may have no value somewhere in it
  /// The bound is the size of a box around the block's surface: it does not fall with the square of that of
  /// cells, as bounds by second derivatives do.
  bool boxed = false;
};

/// The fewest segments of a patch, alone and with what it is joined to, that make no triangle of two corners:
/// 3 along a closed direction, 2 between two poles and between two joints with the same patch.
[[nodiscard]] Segments leastSegments(const Topology& topology, std::uint32_t patch);

/// Blocks that cover every patch once. Nearly the fewest triangles within the tolerance that kd-splits at the
/// middle give; where the surface bends evenly, one block. Tiles without a bound on the second derivatives
/// (kinks, singular edges) are split until the box around them is smaller than the tolerance, as far as a
/// budget goes. Also keeps to a budget of triangles: then `bound` is above the tolerance. With `openSize`
/// blocks in which the formula may have no value are open, and need not be smaller than that.
[[nodiscard]] std::vector<Block> planBlocks(const Surface& surface, std::span<const double> parameters,
                                            const CurvatureMap& map, const MeshDesc& desc,
                                            double openSize = 0);

/// One block per patch: `segments` of each, or the least that work.
[[nodiscard]] std::vector<Block> uniformBlocks(const Surface& surface, std::span<const double> parameters,
                                               Segments segments);

}  // namespace luxo
