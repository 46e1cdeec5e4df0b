// SPDX-License-Identifier: Apache-2.0
// Clusters of triangles: which lie together, in which order, and what bounds them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/triangle_mesh.h"
#include "mesh/vertex_normals.h"

namespace luxo {

/// Puts triangles into clusters of neighbours that face alike, in the order of a vertex cache; vertices into
/// the order of clusters, with those doubled that clusters of two ranges of 65536 vertices share. `indices`
/// become the triangles in the order of clusters, which are without bounds. `groups` are of consecutive
/// triangles and get their clusters; `order` becomes which vertex each was. In parallel; the order does not
/// depend on the number of threads.
[[nodiscard]] std::vector<MeshCluster> makeClusters(std::span<const Vec3f> positions,
                                                    std::vector<std::uint32_t>& indices,
                                                    std::vector<MeshGroup>& groups,
                                                    std::vector<std::uint32_t>& order);

/// Gives clusters box, sphere and cone of normals, all rounded outward, and puts them, and `indices`, into an
/// order that hides much early. In parallel.
void boundClusters(std::vector<MeshCluster>& clusters, std::span<const Vec3f> positions, const Vec3& origin,
                   std::vector<std::uint32_t>& indices);

}  // namespace luxo
