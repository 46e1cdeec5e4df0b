// SPDX-License-Identifier: Apache-2.0
// Normals of vertices from triangles, and the vertices that result.
#pragma once

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

/// Gives every corner of the triangles (three indices each) its normal by the rule, and welds: `vertices`
/// become those that differ in position, uv, normal or at rest, in the order of their first use, and
/// `indices` theirs. Every triangle has an area. `vertices` has normals, of any length, or none. `edges` are
/// those of the triangles, between points; `smoothing` as in MeshArrays.
void giveNormals(MeshVertices& vertices, std::vector<std::uint32_t>& indices, EdgeList edges,
                 std::span<const std::uint32_t> smoothing, const MeshOptions& options);

}  // namespace luxo
