// SPDX-License-Identifier: Apache-2.0
#include "tessellate/tessellator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/assert.h"
#include "surface/surface_triangles.h"
#include "tessellate/block_mesh.h"
#include "tessellate/block_plan.h"
#include "tessellate/curvature_map.h"

namespace luxo {

namespace {

/// Vertices that no triangle of a part uses are left out.
Mesh meshOf(const SurfaceTriangles& triangles) {
  constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
  const TriangleMesh& all = triangles.mesh;
  Mesh mesh{.origin = all.origin()};
  std::vector<std::uint32_t> numberOf(all.positions().size(), kUnused);
  mesh.indices.reserve(std::size_t{3} * triangles.count);
  for (std::uint32_t i = 0; i < triangles.count; ++i)
    for (const std::uint32_t vertex : triangles.corners(i)) {
      std::uint32_t& number = numberOf[vertex];
      if (number == kUnused) {
        number = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.push_back(all.point(vertex));
        mesh.normals.emplace_back(all.normals()[vertex]);
        mesh.parameters.emplace_back(all.uvs().empty() ? Vec2f(0) : all.uvs()[vertex]);
        if (!all.tangents().empty()) mesh.tangents.emplace_back(all.tangents()[vertex]);
        if (!all.rest().empty()) {
          mesh.rest.push_back(all.rest()[vertex]);
          mesh.restNormals.push_back(all.restNormals()[vertex]);
        }
      }
      mesh.indices.push_back(number);
    }
  return mesh;
}

}  // namespace

Mesh tessellate(const Surface& surface, std::span<const double> parameters, const MeshDesc& desc) {
  if (surface.triangles()) return meshOf(*surface.triangles());
  if (desc.uniform)
    return meshOfBlocks(surface, parameters, uniformBlocks(surface, parameters, *desc.uniform));
  return tessellate(surface, parameters, CurvatureMap(surface, parameters), desc);
}

Mesh tessellate(const Surface& surface, std::span<const double> parameters, const CurvatureMap& map,
                const MeshDesc& desc) {
  LUXO_REQUIRE(surface.isParametric());
  LUXO_REQUIRE_COMPARE(desc.tolerance, >, 0.0);
  LUXO_REQUIRE_COMPARE(desc.longestEdge, >, 0.0);
  return meshOfBlocks(surface, parameters, planBlocks(surface, parameters, map, desc));
}

double deviationBound(const Surface& surface, std::span<const double> parameters, Segments segments) {
  if (surface.isPolygonal()) return 0;
  double bound = 0;
  for (const Block& block : uniformBlocks(surface, parameters, segments))
    bound = std::max(bound, block.bound);
  return bound;
}

}  // namespace luxo
