// SPDX-License-Identifier: Apache-2.0
// Tangents of vertices, for normal maps.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/vertex_normals.h"

namespace luxo {

/// One tangent a vertex, by the convention that programs bake normal maps with (Mikkelsen, Simulation of
/// wrinkled surfaces revisited, 2008): of the triangles around it that hang together by edges and whose uvs
/// are mirrored alike, the directions in which u grows, in the plane of the vertex' normal, weighed by
/// angles. Up is to the top of the image, where v is 0. Vertices with several tangents are doubled:
/// `vertices` and `indices` become those that differ, in the order of their first use. Where uvs have no area
/// any tangent will do.
[[nodiscard]] std::vector<Vec4f> giveTangents(MeshVertices& vertices, std::vector<std::uint32_t>& indices);

}  // namespace luxo
