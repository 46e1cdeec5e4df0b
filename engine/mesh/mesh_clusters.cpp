// SPDX-License-Identifier: Apache-2.0
#include "mesh/mesh_clusters.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>

#include "base/assert.h"

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

/// Triangles of one group with their own numbers of vertices, so that its cost is its own, and with positions
/// from -1 to 1, so that no product of them leaves the range of floats.
class GroupClusters {
 public:
  GroupClusters(std::span<const Vec3f> positions, std::span<std::uint32_t> corners,
                std::vector<std::uint32_t>& numbers)
      : corners_(corners) {
    Box box;
    for (const std::uint32_t corner : corners) {
      if (numbers[corner] == kUnused) {
        numbers[corner] = std::uint32_t(vertices_.size());
        vertices_.push_back(corner);
        box.add(Vec3(positions[corner]));
      }
      local_.push_back(numbers[corner]);
    }
    const Vec3 half = 0.5 * box.extent();
    const double scale = std::max({half.x, half.y, half.z});
    for (const std::uint32_t vertex : vertices_) {
      points_.emplace_back((Vec3(positions[vertex]) - box.center()) / scale);
      numbers[vertex] = kUnused;
    }
  }

  /// Puts the corners into the order of clusters, which are added.
  void build(const MeshGroup& group, std::vector<MeshCluster>& clusters) {
    const std::size_t bound = meshopt_buildMeshletsBound(local_.size(), kMeshletVertices, kClusterTriangles);
    std::vector<meshopt_Meshlet> meshlets(bound);
    std::vector<std::uint32_t> vertices(bound * kMeshletVertices);
    std::vector<unsigned char> triangles(bound * kClusterTriangles * 3);
    meshlets.resize(meshopt_buildMeshlets(meshlets.data(), vertices.data(), triangles.data(), local_.data(),
                                          local_.size(), &points_[0].x, points_.size(), sizeof(Vec3f),
                                          kMeshletVertices, kClusterTriangles, kConeWeight));
    std::size_t done = 0;
    std::vector<std::uint32_t> cached;
    for (const meshopt_Meshlet& meshlet : meshlets) {
      const auto local = std::span(triangles).subspan(meshlet.triangle_offset, 3 * meshlet.triangle_count);
      cached.assign(local.begin(), local.end());
      meshopt_optimizeVertexCache(cached.data(), cached.data(), cached.size(), meshlet.vertex_count);
      clusters.push_back({.firstTriangle = group.firstTriangle + std::uint32_t(done / 3),
                          .triangles = meshlet.triangle_count,
                          .material = group.material});
      for (const std::uint32_t corner : cached)
        corners_[done++] = vertices_[vertices[meshlet.vertex_offset + corner]];
    }
    LUXO_REQUIRE_COMPARE(done, ==, corners_.size());
  }

 private:
  static constexpr std::size_t kMeshletVertices = 255;  // the most that the library takes
  // How much narrow cones count against compact clusters; what meshoptimizer's manual begins with.
  static constexpr float kConeWeight = 0.25f;

  std::span<std::uint32_t> corners_;
  std::vector<std::uint32_t> local_, vertices_;  ///< vertices_: which each was
  std::vector<Vec3f> points_;
};

// Where a cluster lies, and which way it faces.
struct Place {
  MeshCluster cluster;
  Vec3 middle{0}, normal{0};
};

class ClusterOrder {
 public:
  ClusterOrder(std::span<const Vec3f> positions, std::vector<std::uint32_t>& indices,
               std::vector<MeshCluster>& clusters)
      : indices_(indices), clusters_(clusters) {
    for (const MeshCluster& cluster : clusters) {
      Place place{cluster};
      const auto corners = cornersOf(cluster);
      const auto at = [&](std::size_t corner) { return Vec3(positions[corners[corner]]); };
      for (std::size_t i = 0; i < corners.size(); i += 3) {
        place.normal += unit(glm::cross(at(i + 1) - at(i), at(i + 2) - at(i)));
        place.middle += at(i) / double(cluster.triangles);
      }
      place.normal = unit(place.normal);
      box_.add(place.middle);
      places_.push_back(place);
    }
  }

  // Along the longest side, each material for itself: then few vertices are at the borders of two ranges.
  void sortForLocality() {
    const Vec3 extent = box_.extent();
    const int axis = extent.x > extent.y ? (extent.x > extent.z ? 0 : 2) : (extent.y > extent.z ? 1 : 2);
    std::stable_sort(places_.begin(), places_.end(), [axis](const Place& a, const Place& b) {
      return a.cluster.material != b.cluster.material ? a.cluster.material < b.cluster.material
                                                      : a.middle[axis] < b.middle[axis];
    });
    apply();
  }

  // What faces outward far from the middle hides most of the rest, so it comes first (Sander, Nehab, Barczak,
  // Fast triangle reordering for vertex locality and reduced overdraw, 2007); within what shares a range of
  // vertices.
  void sortForOverdraw() {
    for (std::size_t i = 0; i < places_.size(); ++i) places_[i].cluster = clusters_[i];
    const auto outward = [&](const Place& place) {
      return glm::dot(place.middle - box_.center(), place.normal);
    };
    for (auto begin = places_.begin(); begin != places_.end();) {
      const auto end = std::find_if(begin, places_.end(), [&](const Place& place) {
        return place.cluster.material != begin->cluster.material ||
               place.cluster.firstVertex != begin->cluster.firstVertex;
      });
      std::stable_sort(begin, end, [&](const Place& a, const Place& b) { return outward(a) > outward(b); });
      begin = end;
    }
    apply();
  }

 private:
  [[nodiscard]] std::span<const std::uint32_t> cornersOf(const MeshCluster& cluster) const {
    return std::span(indices_).subspan(3 * std::size_t(cluster.firstTriangle),
                                       3 * std::size_t(cluster.triangles));
  }
  void apply() {
    std::vector<std::uint32_t> sorted;
    sorted.reserve(indices_.size());
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const auto corners = cornersOf(places_[i].cluster);
      places_[i].cluster.firstTriangle = std::uint32_t(sorted.size() / 3);
      sorted.insert(sorted.end(), corners.begin(), corners.end());
      clusters_[i] = places_[i].cluster;
    }
    indices_ = std::move(sorted);
  }

  std::vector<std::uint32_t>& indices_;
  std::vector<MeshCluster>& clusters_;
  std::vector<Place> places_;
  Box box_;
};

}  // namespace

std::vector<MeshCluster> makeClusters(std::span<const Vec3f> positions, std::vector<std::uint32_t>& indices,
                                      std::vector<MeshGroup>& groups, std::vector<std::uint32_t>& order) {
  std::vector<MeshCluster> clusters;
  {
    std::vector<std::uint32_t> numbers(positions.size(), kUnused);
    for (MeshGroup& group : groups) {
      group.firstCluster = std::uint32_t(clusters.size());
      const auto corners =
          std::span(indices).subspan(3 * std::size_t(group.firstTriangle), 3 * std::size_t(group.triangles));
      GroupClusters(positions, corners, numbers).build(group, clusters);
      group.clusters = std::uint32_t(clusters.size()) - group.firstCluster;
    }
  }
  ClusterOrder sorting(positions, indices, clusters);
  sorting.sortForLocality();
  order = numberVertices(positions.size(), indices, clusters);
  sorting.sortForOverdraw();
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
