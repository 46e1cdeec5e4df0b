// SPDX-License-Identifier: Apache-2.0
#include "mesh/mesh_clusters.h"

#include <algorithm>
#include <cmath>

namespace luxo {
namespace {

constexpr std::uint32_t kRange = 65536;  // vertices that 16 bits number
constexpr std::uint32_t kUnused = 0xffffffff;

// Numbers the vertices in the order of their use, from a new range on where a cluster does not fit the last.
std::vector<std::uint32_t> numberVertices(std::size_t vertices, std::vector<std::uint32_t>& indices,
                                          std::vector<MeshCluster>& clusters) {
  std::vector<std::uint32_t> order;
  order.reserve(vertices);
  std::vector<std::uint32_t> numbers(vertices, kUnused);
  std::uint32_t range = 0;
  const auto fresh = [&](std::uint32_t vertex) {
    return numbers[vertex] == kUnused || numbers[vertex] < range;
  };
  for (MeshCluster& cluster : clusters) {
    const auto corners =
        std::span(indices).subspan(3 * std::size_t(cluster.firstTriangle), 3 * cluster.triangles);
    const auto most = std::size_t(std::count_if(corners.begin(), corners.end(), fresh));
    if (order.size() + most - range > kRange) range = std::uint32_t(order.size());
    cluster.firstVertex = range;
    for (std::uint32_t& corner : corners) {
      if (fresh(corner)) {
        numbers[corner] = std::uint32_t(order.size());
        order.push_back(corner);
      }
      corner = numbers[corner];
    }
  }
  return order;
}

}  // namespace

std::vector<MeshCluster> makeClusters(std::span<const Vec3f> positions, std::vector<std::uint32_t>& indices,
                                      std::vector<MeshGroup>& groups, std::vector<std::uint32_t>& order) {
  std::vector<MeshCluster> clusters;
  for (MeshGroup& group : groups) {
    group.firstCluster = std::uint32_t(clusters.size());
    for (std::uint32_t done = 0; done < group.triangles; done += kClusterTriangles)
      clusters.push_back({.firstTriangle = group.firstTriangle + done,
                          .triangles = std::min(kClusterTriangles, group.triangles - done),
                          .material = group.material});
    group.clusters = std::uint32_t(clusters.size()) - group.firstCluster;
  }
  order = numberVertices(positions.size(), indices, clusters);
  return clusters;
}

void boundCluster(MeshCluster& cluster, std::span<const Vec3f> positions, const Vec3& origin,
                  std::span<const std::uint32_t> indices) {
  const auto corners =
      indices.subspan(3 * std::size_t(cluster.firstTriangle), 3 * std::size_t(cluster.triangles));
  const auto at = [&](std::size_t corner) { return Vec3(positions[corners[corner]]); };
  for (std::size_t i = 0; i < corners.size(); ++i) cluster.bounds.add(origin + at(i));
  cluster.sphere.center = cluster.bounds.center();
  double squared = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 toPoint = origin + at(i) - cluster.sphere.center;
    squared = std::max(squared, glm::dot(toPoint, toPoint));
  }
  // Of three squares and a root: below 4 roundings, 2^-53 each.
  cluster.sphere.radius = std::sqrt(squared) * (1 + 1e-15);

  // The edges of a triangle are exact unless one is 2^29 times another; so are their products then, but for
  // one rounding each, which is what the direction of a sliver's normal is off by.
  constexpr double kProducts = 4 * 1.2e-16;
  std::vector<Vec3> normals;
  std::vector<double> doubts;
  Vec3 sum(0);
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    const Vec3 a = at(i + 1) - at(i), b = at(i + 2) - at(i), normal = glm::cross(a, b);
    normals.push_back(unit(normal));
    doubts.push_back(kProducts * (glm::length(a) / glm::length(normal)) * glm::length(b));
    sum += normals.back();
  }
  cluster.axis = unit(sum);
  double spread = 0;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const bool within = glm::dot(normals[i], cluster.axis) > 0;
    // sin(a + b) <= sin(a) + sin(b); the unit vectors and the product are off by less than 1e-15.
    spread = std::max(spread,
                      within ? glm::length(glm::cross(normals[i], cluster.axis)) + doubts[i] + 1e-15 : 1.0);
  }
  cluster.spread = spread < 1 ? spread : 1;
}

}  // namespace luxo
