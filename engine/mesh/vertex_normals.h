// SPDX-License-Identifier: Apache-2.0
// Normals of vertices from triangles, and the vertices that result.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh_topology.h"
#include "mesh/triangle_mesh.h"

namespace luxo {

/// Vertices as a mesh keeps them: positions without -0, unit normals; uvs, or none; what they were at rest,
/// or none.
struct MeshVertices {
  std::vector<Vec3f> positions, normals;
  std::vector<Vec2f> uvs;
  std::vector<Vec3f> rest, restNormals;
};

/// The value of each number; none where there are no values.
template <class T>
[[nodiscard]] std::vector<T> reordered(const std::vector<T>& values,
                                       const std::vector<std::uint32_t>& order) {
  if (values.empty()) return {};
  std::vector<T> result(order.size());
  std::transform(order.begin(), order.end(), result.begin(), [&](std::uint32_t i) { return values[i]; });
  return result;
}

/// Gives every corner of the triangles (three indices each) its normal by the rule, and welds: `vertices`
/// become those that differ in position, uv, normal or at rest, in the order of their first use, and
/// `indices` theirs. Every triangle has an area. `vertices` has normals, of any length, or none. `edges` are
/// those of the triangles, between points; `smoothing` as in MeshArrays. What comes back says which of its
/// normals each vertex has: flat ones are a third of the vertices, until these are in their last order.
[[nodiscard]] std::vector<std::uint32_t> giveNormals(MeshVertices& vertices,
                                                     std::vector<std::uint32_t>& indices, EdgeList edges,
                                                     std::span<const std::uint32_t> smoothing,
                                                     const MeshOptions& options);

}  // namespace luxo
