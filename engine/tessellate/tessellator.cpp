// SPDX-License-Identifier: Apache-2.0
#include "tessellate/tessellator.h"

#include <algorithm>
#include <cmath>

#include "base/assert.h"
#include "tessellate/block_mesh.h"
#include "tessellate/block_plan.h"
#include "tessellate/curvature_map.h"

namespace luxo {

Mesh tessellate(const Surface& surface, std::span<const double> parameters, const MeshDesc& desc) {
  if (desc.uniform)
    return meshOfBlocks(surface, parameters, uniformBlocks(surface, parameters, *desc.uniform));
  return tessellate(surface, parameters, CurvatureMap(surface, parameters), desc);
}

Mesh tessellate(const Surface& surface, std::span<const double> parameters, const CurvatureMap& map,
                const MeshDesc& desc) {
  LUXO_REQUIRE_COMPARE(desc.tolerance, >, 0.0);
  LUXO_REQUIRE_COMPARE(desc.longestEdge, >, 0.0);
  return meshOfBlocks(surface, parameters, planBlocks(surface, parameters, map, desc));
}

double deviationBound(const Surface& surface, std::span<const double> parameters, Segments segments) {
  double bound = 0;
  for (const Block& block : uniformBlocks(surface, parameters, segments))
    bound = std::max(bound, block.bound);
  return bound;
}

}  // namespace luxo
