// SPDX-License-Identifier: Apache-2.0
#include "mesh/mesh_clusters.h"

#include <meshoptimizer.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "mesh/index_windows.h"

namespace luxo {
namespace {

constexpr std::uint32_t kUnused = 0xffffffff;
constexpr unsigned kCachedVertices = 16;  // what devices of any age keep
// Pieces of work that are worth another thread: some 0.1 ms.
constexpr std::size_t kWorthThreads = 8192;

template <class Work>
void forEachIndex(std::size_t count, const Work& work) {
  // This thread may hold locks of its caller's, and takes no work of others while it waits.
  tbb::this_task_arena::isolate([&] { tbb::parallel_for(std::size_t(0), count, work); });
}

[[nodiscard]] std::span<std::uint32_t> cornersOf(const MeshCluster& cluster,
                                                 std::vector<std::uint32_t>& indices) {
  return std::span(indices).subspan(3 * std::size_t(cluster.firstTriangle),
                                    3 * std::size_t(cluster.triangles));
}

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
    const std::span<std::uint32_t> corners = cornersOf(cluster, indices);
    const auto most = std::size_t(std::count_if(corners.begin(), corners.end(), fresh));
    if (order.size() + most - range > kWindowVertices) range = std::uint32_t(order.size());
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

/// What decides into which cluster a triangle goes.
struct Candidate {
  /// Its middle, and its normal, which is as long as a cluster is wide: what lies together but faces
  /// elsewhere is as far apart as clusters are.
  std::array<float, 6> place{};
  std::uint32_t triangle = 0;
};

/// The triangles of a group in a tree of planes, each across what spreads most and with as many clusters on
/// either side (Bentley, Multidimensional binary search trees used for associative searching, 1975).
class ClusterTree {
 public:
  ClusterTree(std::span<const Vec3f> positions, std::span<const std::uint32_t> corners)
      : candidates_(corners.size() / 3) {
    Box box;
    for (const std::uint32_t corner : corners) box.add(Vec3(positions[corner]));
    // From -1 to 1 no product leaves the range of floats.
    const Vec3 half = 0.5 * box.extent();
    const double scale = 1 / std::max({half.x, half.y, half.z});
    const auto at = [&](std::size_t corner) {
      return (Vec3(positions[corners[corner]]) - box.center()) * scale;
    };
    double area = 0;
    for (std::size_t i = 0; i < corners.size(); i += 3)
      area += 0.5 * glm::length(glm::cross(at(i + 1) - at(i), at(i + 2) - at(i)));
    const double width = std::sqrt(area / double(candidates_.size()) * kClusterTriangles);
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      const Vec3 a = at(3 * i), b = at(3 * i + 1), c = at(3 * i + 2);
      const Vec3f middle((a + b + c) / 3.0), normal(width * unit(glm::cross(b - a, c - a)));
      candidates_[i] = {{middle.x, middle.y, middle.z, normal.x, normal.y, normal.z}, std::uint32_t(i)};
    }
    tbb::this_task_arena::isolate([&] { split(candidates_); });
  }

  /// The order of the triangles: each kClusterTriangles are a cluster, and the rest.
  [[nodiscard]] const std::vector<Candidate>& order() const { return candidates_; }

 private:
  static void split(std::span<Candidate> candidates) {
    if (candidates.size() <= kClusterTriangles) {
      std::sort(candidates.begin(), candidates.end(),
                [](const Candidate& a, const Candidate& b) { return a.triangle < b.triangle; });
      return;
    }
    const std::size_t clusters = (candidates.size() + kClusterTriangles - 1) / kClusterTriangles;
    const std::size_t lower = clusters / 2 * kClusterTriangles;
    std::nth_element(candidates.begin(), candidates.begin() + std::ptrdiff_t(lower), candidates.end(),
                     [axis = widestAxis(candidates)](const Candidate& a, const Candidate& b) {
                       return a.place[axis] != b.place[axis] ? a.place[axis] < b.place[axis]
                                                             : a.triangle < b.triangle;
                     });
    const auto below = [&] { split(candidates.first(lower)); };
    const auto above = [&] { split(candidates.subspan(lower)); };
    candidates.size() >= kWorthThreads ? tbb::parallel_invoke(below, above) : (below(), above());
  }
  [[nodiscard]] static std::size_t widestAxis(std::span<const Candidate> candidates) {
    std::array<float, 6> low = candidates.front().place, high = low;
    for (const Candidate& candidate : candidates)
      for (std::size_t axis = 0; axis < 6; ++axis) {
        low[axis] = std::min(low[axis], candidate.place[axis]);
        high[axis] = std::max(high[axis], candidate.place[axis]);
      }
    std::size_t widest = 0;
    for (std::size_t axis = 1; axis < 6; ++axis)
      if (high[axis] - low[axis] > high[widest] - low[widest]) widest = axis;
    return widest;
  }

  std::vector<Candidate> candidates_;
};

/// Puts the triangles of a cluster into the order of a vertex cache.
void orderForCache(std::span<std::uint32_t> corners) {
  // The vertices by their own numbers; more slots than a cluster has corners.
  constexpr std::size_t kSlots = 512;
  static_assert(kSlots > 3 * kClusterTriangles && std::has_single_bit(kSlots));
  std::array<std::uint32_t, kSlots> numbers;
  numbers.fill(kUnused);
  std::array<std::uint32_t, 3 * kClusterTriangles> vertices{}, local{}, ordered{};
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    std::size_t slot = corners[i] % kSlots;
    while (numbers[slot] != kUnused && vertices[numbers[slot]] != corners[i]) slot = (slot + 1) % kSlots;
    if (numbers[slot] == kUnused) {
      vertices[count] = corners[i];
      numbers[slot] = count++;
    }
    local[i] = numbers[slot];
  }
  meshopt_optimizeVertexCacheFifo(ordered.data(), local.data(), corners.size(), count, kCachedVertices);
  for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = vertices[ordered[i]];
}

/// Puts the corners of a group into the order of clusters, which are added.
void clusterGroup(std::span<const Vec3f> positions, MeshGroup& group, std::vector<std::uint32_t>& indices,
                  std::vector<MeshCluster>& clusters) {
  const auto corners =
      std::span(indices).subspan(3 * std::size_t(group.firstTriangle), 3 * std::size_t(group.triangles));
  {
    const ClusterTree tree(positions, corners);
    const std::vector<std::uint32_t> given(corners.begin(), corners.end());
    for (std::size_t i = 0; i < tree.order().size(); ++i)
      std::copy_n(given.begin() + 3 * std::ptrdiff_t(tree.order()[i].triangle), 3,
                  corners.begin() + 3 * std::ptrdiff_t(i));
  }
  group.firstCluster = std::uint32_t(clusters.size());
  group.clusters = (group.triangles + kClusterTriangles - 1) / kClusterTriangles;
  for (std::uint32_t done = 0; done < group.triangles; done += kClusterTriangles)
    clusters.push_back({.firstTriangle = group.firstTriangle + done,
                        .triangles = std::min(kClusterTriangles, group.triangles - done),
                        .material = group.material});
}

/// Box, sphere and cone of normals, all rounded outward.
void boundCluster(MeshCluster& cluster, std::span<const Vec3f> positions, const Vec3& origin,
                  std::span<const std::uint32_t> corners) {
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
  cluster.thinnest = std::numeric_limits<double>::infinity();
  Vec3 sum(0);
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    const Vec3 a = at(i + 1) - at(i), b = at(i + 2) - at(i), normal = glm::cross(a, b);
    normals.push_back(unit(normal));
    doubts.push_back(kProducts * (glm::length(a) / glm::length(normal)) * glm::length(b));
    // Twice the area over the longest side; what both are off by besides is below 1e-15 of it.
    const double longest = std::max({glm::length(a), glm::length(b), glm::length(b - a)});
    cluster.thinnest = std::min(cluster.thinnest,
                                glm::length(normal) / longest * (1 - std::min(1.0, doubts.back() + 1e-15)));
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

// What faces outward far from the middle hides most of the rest, so it comes first (Sander, Nehab, Barczak,
// Fast triangle reordering for vertex locality and reduced overdraw, 2007); within what shares a range of
// vertices.
void sortForOverdraw(std::vector<MeshCluster>& clusters, std::vector<std::uint32_t>& indices) {
  Box middles;
  for (const MeshCluster& cluster : clusters) middles.add(cluster.sphere.center);
  const auto outward = [&](const MeshCluster& cluster) {
    return glm::dot(cluster.sphere.center - middles.center(), cluster.axis);
  };
  std::vector<std::uint32_t> sorted;
  sorted.reserve(indices.size());
  for (auto begin = clusters.begin(); begin != clusters.end();) {
    const auto end = std::find_if(begin, clusters.end(), [&](const MeshCluster& cluster) {
      return cluster.material != begin->material || cluster.firstVertex != begin->firstVertex;
    });
    std::stable_sort(begin, end,
                     [&](const MeshCluster& a, const MeshCluster& b) { return outward(a) > outward(b); });
    for (; begin != end; ++begin) {
      const auto corners = cornersOf(*begin, indices);
      begin->firstTriangle = std::uint32_t(sorted.size() / 3);
      sorted.insert(sorted.end(), corners.begin(), corners.end());
    }
  }
  indices = std::move(sorted);
}

}  // namespace

std::vector<MeshCluster> makeClusters(std::span<const Vec3f> positions, std::vector<std::uint32_t>& indices,
                                      std::vector<MeshGroup>& groups, std::vector<std::uint32_t>& order) {
  std::vector<MeshCluster> clusters;
  for (MeshGroup& group : groups) clusterGroup(positions, group, indices, clusters);
  forEachIndex(clusters.size(), [&](std::size_t i) { orderForCache(cornersOf(clusters[i], indices)); });
  order = numberVertices(positions.size(), indices, clusters);
  return clusters;
}

void boundClusters(std::vector<MeshCluster>& clusters, std::span<const Vec3f> positions, const Vec3& origin,
                   std::vector<std::uint32_t>& indices) {
  forEachIndex(clusters.size(), [&](std::size_t i) {
    boundCluster(clusters[i], positions, origin, cornersOf(clusters[i], indices));
  });
  sortForOverdraw(clusters, indices);
}

}  // namespace luxo
