// SPDX-License-Identifier: Apache-2.0
// Triangles of one surface: what the tessellator makes and the renderer uploads.
#pragma once

#include <cstdint>
#include <vector>

#include "math/vec.h"

namespace luxo {

/// Indexed triangle list in object space, metres, double. Front faces (counter-clockwise from outside) follow
/// the surface's outward normal. Where edges of the surface are joined there is a vertex for each, with the
/// same bits of position and with its own parameters; where an edge is one point, there is a vertex for every
/// triangle that ends there. So parameters can be interpolated in every triangle, and there are no cracks.
struct Mesh {
  std::vector<Vec3> positions;
  std::vector<Vec3> normals;     ///< unit, outward, exact at the vertex; the limit at poles
  std::vector<Vec2> parameters;  ///< (u, v) of each vertex; at poles the middle of the triangle's
  std::vector<Vec4> tangents;    ///< of triangles that have some (TriangleMesh::tangents()); else none
  std::vector<Vec3f> rest, restNormals;  ///< of triangles that a program has moved (TriangleMesh::rest())
  std::vector<std::uint32_t> indices;
  /// Proven: no point of the surface is farther (object units) from its own triangle, and no point of a
  /// triangle from its own point of the surface. Infinite where nothing could be proven, and where triangles
  /// are missing.
  double bound = 0;
  /// What the device's single precision is relative to: 0, or the middle of a surface that is farther from
  /// the origin than it is large.
  Vec3 origin{0};
  /// Triangles that are missing because the formula has no finite value at a corner.
  std::uint64_t dropped = 0;

  [[nodiscard]] std::size_t triangleCount() const { return indices.size() / 3; }
};

}  // namespace luxo
