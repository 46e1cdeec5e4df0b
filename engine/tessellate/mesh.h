// SPDX-License-Identifier: Apache-2.0
// Triangles of one surface: what the tessellator makes and the renderer uploads.
#pragma once

#include <cstdint>
#include <vector>

#include "math/vec.h"
#include "surface/segments.h"

namespace luxo {

/// Indexed triangle list in object space, metres, double. Front faces (counter-clockwise from outside) follow
/// the surface's outward normal. The first vertex of every triangle lies in the lower-left corner of its
/// parameter cell as far as that corner is not collapsed, which lets a shader tell which column and row a
/// triangle belongs to.
struct Mesh {
  std::vector<Vec3> positions;
  std::vector<Vec3> normals;  ///< unit, outward, exact at the vertex; the limit at poles
  std::vector<Vec2>
      parameters;  ///< (u, v) of each vertex; at a seam the lower end's, at a pole an arbitrary u
  std::vector<std::uint32_t> indices;
  Segments segments;
  double bound =
      0;  ///< proven: no point of the surface is farther (object units) from its own cell's triangles

  [[nodiscard]] std::size_t triangleCount() const { return indices.size() / 3; }
};

}  // namespace luxo
