// SPDX-License-Identifier: Apache-2.0
#include "mesh/mesh_solid.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numeric>
#include <span>
#include <vector>

#include "math/disjoint_sets.h"
#include "mesh/mesh_topology.h"

namespace luxo {
namespace {

/// Of the product of the lengths that a number is made of: less is not certain to have that sign. Rounding is
/// below 2^-48 of it.
constexpr double kCertain = 1e-12;

using Corners = std::array<Vec3, 3>;

double lengths(const Vec3& a, const Vec3& b) { return glm::length(a) * glm::length(b); }

/// The sign of x along a product of two edges whose lengths have that product, or 0.
int sideOf(const Vec3& normal, double ofNormal, const Vec3& x) {
  const double along = glm::dot(normal, x);
  return std::abs(along) > kCertain * ofNormal * glm::length(x) ? (along > 0 ? 1 : -1) : 0;
}

/// Whether the plane through an axis that is given by a product of edges keeps triangles apart, with a gap.
bool parts(const Vec3& axis, double ofAxis, const Corners& a, const Corners& b) {
  const auto along = [&](const Vec3& point) { return glm::dot(axis, point - a[0]); };
  double reach = 0;
  for (const Corners* corners : {&a, &b})
    for (const Vec3& corner : *corners) reach = std::max(reach, glm::distance(corner, a[0]));
  const auto [lowA, highA] = std::minmax({along(a[0]), along(a[1]), along(a[2])});
  const auto [lowB, highB] = std::minmax({along(b[0]), along(b[1]), along(b[2])});
  return std::max(lowA - highB, lowB - highA) > kCertain * ofAxis * reach;
}

/// Triangles without a common corner: some plane is between them along a face, across two edges, or across a
/// face along an edge (Gottschalk, Lin, Manocha, OBBTree, 1996).
bool areApart(const Corners& a, const Corners& b) {
  const auto edges = [](const Corners& t) { return Corners{t[1] - t[0], t[2] - t[1], t[0] - t[2]}; };
  const Corners ofA = edges(a), ofB = edges(b);
  const auto parted = [&](const Vec3& e, const Vec3& f) {
    return parts(glm::cross(e, f), lengths(e, f), a, b);
  };
  if (parted(ofA[0], ofA[1]) || parted(ofB[0], ofB[1])) return true;
  for (const Vec3& e : ofA)
    for (const Vec3& f : ofB)
      if (parted(e, f)) return true;
  for (const Corners* own : {&ofA, &ofB}) {
    const Vec3 normal = glm::cross((*own)[0], (*own)[1]);
    for (const Vec3& e : *own)
      if (parts(glm::cross(normal, e), lengths((*own)[0], (*own)[1]) * glm::length(e), a, b)) return true;
  }
  return false;
}

/// Triangles with one common corner, by their other corners from there. A plane through it has one of them on
/// one side, with no more than an edge in it, and the other one on the other, with no more than another edge.
bool areApart(const std::array<Vec3, 2>& a, const std::array<Vec3, 2>& b) {
  const auto oneSided = [](const std::array<Vec3, 2>& plane, const std::array<Vec3, 2>& other) {
    const Vec3 normal = glm::cross(plane[0], plane[1]);
    const double size = lengths(plane[0], plane[1]);
    const int side = sideOf(normal, size, other[0]);
    return side != 0 && side == sideOf(normal, size, other[1]);
  };
  if (oneSided(a, b) || oneSided(b, a)) return true;
  for (int i = 0; i < 2; ++i)
    for (int k = 0; k < 2; ++k) {
      const Vec3 normal = glm::cross(a[i], b[k]);
      const double size = lengths(a[i], b[k]);
      if (sideOf(normal, size, a[1 - i]) * sideOf(normal, size, b[1 - k]) < 0) return true;
    }
  const Vec3 between = unit(a[0]) + unit(a[1]) - unit(b[0]) - unit(b[1]);
  const auto sides = [&](const std::array<Vec3, 2>& of) {
    const int side = sideOf(between, 4, of[0]);
    return side == sideOf(between, 4, of[1]) ? side : 0;
  };
  if (sides(a) * sides(b) < 0) return true;
  // Where both lie in about one plane.
  const auto beside = [](const std::array<Vec3, 2>& from, const std::array<Vec3, 2>& other) {
    const Vec3 face = glm::cross(from[0], from[1]);
    for (int i = 0; i < 2; ++i) {
      const Vec3 normal = glm::cross(face, from[i]);
      const double size = lengths(from[0], from[1]) * glm::length(from[i]);
      const int own = sideOf(normal, size, from[1 - i]);
      if (own != 0 && sideOf(normal, size, other[0]) == -own && sideOf(normal, size, other[1]) == -own)
        return true;
    }
    return false;
  };
  return beside(a, b) || beside(b, a);
}

/// Triangles with a common edge, by that and their other corners, from one end of it: they are not folded
/// onto each other.
bool areApart(const Vec3& edge, const Vec3& a, const Vec3& b) {
  const Vec3 ofA = glm::cross(edge, a), ofB = glm::cross(edge, b);
  return glm::dot(ofA, ofB) <
         (1 - kCertain) * lengths(ofA, ofB) - kCertain * glm::dot(edge, edge) * lengths(a, b);
}

class SolidTest {
 public:
  explicit SolidTest(const TriangleMesh& mesh) : mesh_(mesh), points_(pointNumbers(mesh.positions())) {
    std::vector<std::uint32_t> corners(mesh.indices().size());
    std::ranges::transform(mesh.indices(), corners.begin(), [&](std::uint32_t i) { return points_[i]; });
    DisjointSets surfaces(mesh.triangleCount());
    EdgeList(corners, points_.size()).forEach([&](std::span<const EdgeUse> uses) {
      isClosed_ = isClosed_ && uses.size() == 2 && uses[0].forward != uses[1].forward;
      if (isClosed_) surfaces.unite(uses[0].corner / 3, uses[1].corner / 3);
    });
    surfaceOf_.resize(mesh.triangleCount());
    for (std::uint32_t t = 0; t < surfaceOf_.size(); ++t) surfaceOf_[t] = surfaces.find(t).number;
  }

  /// Into surfaces all edges of which join two triangles that go along them opposite ways.
  [[nodiscard]] bool isClosed() const { return isClosed_; }

  [[nodiscard]] bool volumesArePositive() const {
    std::vector<double> volumes(surfaceOf_.size()), sizes(surfaceOf_.size());
    for (std::uint32_t t = 0; t < surfaceOf_.size(); ++t) {
      const Corners c = cornersOf(t);
      volumes[surfaceOf_[t]] += glm::dot(c[0], glm::cross(c[1], c[2]));
      sizes[surfaceOf_[t]] += glm::length(c[0]) * lengths(c[1], c[2]);
    }
    for (std::uint32_t t = 0; t < surfaceOf_.size(); ++t)
      if (surfaceOf_[t] == t && !(volumes[t] > kCertain * sizes[t])) return false;
    return true;
  }

  [[nodiscard]] bool nothingMeets() {
    const std::span<const MeshCluster> clusters = mesh_.clusters();
    boxes_.resize(surfaceOf_.size());
    clusterBoxes_.resize(clusters.size());
    for (std::size_t i = 0; i < clusters.size(); ++i) {
      const MeshCluster& c = clusters[i];
      for (std::uint32_t t = c.firstTriangle; t < c.firstTriangle + c.triangles; ++t) {
        for (const Vec3& corner : cornersOf(t)) boxes_[t].add(corner);
        clusterBoxes_[i].add(boxes_[t]);
      }
    }
    const Vec3 extent = mesh_.bounds().extent();
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    std::vector<std::uint32_t> order(clusters.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::sort(order, {}, [&](std::uint32_t i) { return clusterBoxes_[i].min[axis]; });
    std::atomic<bool> apart = true;
    tbb::this_task_arena::isolate([&] {
      tbb::parallel_for(std::size_t{0}, order.size(), [&](std::size_t i) {
        const Box& box = clusterBoxes_[order[i]];
        for (std::size_t k = i; k < order.size() && apart; ++k) {
          const Box& other = clusterBoxes_[order[k]];
          if (other.min[axis] > box.max[axis]) break;
          if (overlap(box, other) && !clustersAreApart(order[i], order[k])) apart = false;
        }
      });
    });
    return apart;
  }

 private:
  [[nodiscard]] Corners cornersOf(std::uint32_t triangle) const {
    const auto at = mesh_.indices().subspan(std::size_t{3} * triangle, 3);
    const auto positions = mesh_.positions();
    return {Vec3(positions[at[0]]), Vec3(positions[at[1]]), Vec3(positions[at[2]])};
  }

  [[nodiscard]] bool clustersAreApart(std::uint32_t a, std::uint32_t b) const {
    const auto near = [&](std::uint32_t cluster, std::uint32_t other) {
      std::vector<std::uint32_t> triangles;
      const MeshCluster& c = mesh_.clusters()[cluster];
      for (std::uint32_t t = c.firstTriangle; t < c.firstTriangle + c.triangles; ++t)
        if (overlap(boxes_[t], clusterBoxes_[other])) triangles.push_back(t);
      return triangles;
    };
    const std::vector<std::uint32_t> ofA = near(a, b), ofB = near(b, a);
    for (const std::uint32_t s : ofA)
      for (const std::uint32_t t : ofB)
        if ((a != b || s < t) && surfaceOf_[s] == surfaceOf_[t] && overlap(boxes_[s], boxes_[t]) &&
            !trianglesAreApart(s, t))
          return false;
    return true;
  }

  [[nodiscard]] bool trianglesAreApart(std::uint32_t s, std::uint32_t t) const {
    Corners a = cornersOf(s), b = cornersOf(t);
    // Those that are common first.
    int common = 0;
    for (int i = 0; i < 3; ++i)
      for (int k = common; k < 3; ++k) {
        if (a[i] != b[k]) continue;
        std::swap(a[common], a[i]);
        std::swap(b[common++], b[k]);
        break;
      }
    if (common == 0) return areApart(a, b);
    if (common == 1)
      return areApart(std::array{a[1] - a[0], a[2] - a[0]}, std::array{b[1] - b[0], b[2] - b[0]});
    return common == 2 && areApart(a[1] - a[0], a[2] - a[0], b[2] - b[0]);
  }

  const TriangleMesh& mesh_;
  bool isClosed_ = true;
  std::vector<std::uint32_t> points_;      ///< by vertex
  std::vector<std::uint32_t> surfaceOf_;   ///< by triangle: the first triangle of its surface
  std::vector<Box> boxes_, clusterBoxes_;  ///< by triangle and by cluster, relative to the mesh's origin
};

/// What a line from the origin along an axis leaves triangles by: their fronts count 1, their backs -1.
class Crossings {
 public:
  Crossings(int axis, bool forward, double slack)
      : axis_(axis), right_((axis + 1) % 3), up_((axis + 2) % 3), way_(forward ? 1 : -1), slack_(slack) {}

  /// Whether the line may meet anything in the box.
  [[nodiscard]] bool mayMeet(const Box& box) const {
    return box.min[right_] <= slack_ && box.max[right_] >= -slack_ && box.min[up_] <= slack_ &&
           box.max[up_] >= -slack_ && (way_ > 0 ? box.max[axis_] >= -slack_ : box.min[axis_] <= slack_);
  }

  /// False where it is not certain whether the line meets the triangle.
  [[nodiscard]] bool add(const Corners& t) {
    Box box;
    for (const Vec3& corner : t) box.add(corner);
    if (!mayMeet(box)) return true;
    std::array<int, 3> sides{};
    for (int k = 0; k < 3; ++k) {
      const Vec3 &a = t[k], &b = t[(k + 1) % 3];
      const double twice = a[right_] * b[up_] - a[up_] * b[right_],
                   doubt = 2 * slack_ * (glm::length(a) + glm::length(b) + slack_);
      sides[k] = twice > doubt ? 1 : twice < -doubt ? -1 : 0;
    }
    const auto [least, most] = std::ranges::minmax(sides);
    if (least < 0 && most > 0) return true;
    if (least != most || least == 0) return false;
    const Vec3 e = t[1] - t[0], f = t[2] - t[0];
    // How far along the line it is, times an area.
    const double along = way_ * least * glm::dot(glm::cross(e, f), t[0]),
                 doubt = 4 * slack_ *
                         (lengths(e, f) +
                          (glm::length(t[0]) + slack_) * (glm::length(e) + glm::length(f) + slack_));
    if (std::abs(along) <= doubt) return false;
    if (along > 0) sum_ += way_ * least;
    return true;
  }

  [[nodiscard]] int sum() const { return sum_; }

 private:
  int axis_, right_, up_, way_;
  double slack_;
  int sum_ = 0;
};

}  // namespace

std::optional<int> windingNumber(const TriangleMesh& mesh, const Transform& place, const Vec3& point,
                                 double slack) {
  const Transform relative{place.linear, place.translation - point};
  const auto cornersOf = [&](std::uint32_t triangle) {
    const auto at = mesh.indices().subspan(std::size_t{3} * triangle, 3);
    return Corners{transformPoint(relative, mesh.point(at[0])), transformPoint(relative, mesh.point(at[1])),
                   transformPoint(relative, mesh.point(at[2]))};
  };
  const auto along = [&](int axis, bool forward) -> std::optional<int> {
    Crossings crossings(axis, forward, slack);
    for (const MeshCluster& cluster : mesh.clusters()) {
      if (!crossings.mayMeet(transformBounds(relative, cluster.bounds))) continue;
      for (std::uint32_t t = cluster.firstTriangle; t < cluster.firstTriangle + cluster.triangles; ++t)
        if (!crossings.add(cornersOf(t))) return std::nullopt;
    }
    return mirrors(place) ? -crossings.sum() : crossings.sum();
  };
  for (const int axis : {0, 1, 2})
    for (const bool forward : {true, false})
      if (const std::optional<int> number = along(axis, forward)) return number;
  return std::nullopt;
}

bool boundsSolid(const TriangleMesh& mesh) {
  if (!mesh.closed()) return false;
  SolidTest test(mesh);
  return test.isClosed() && test.volumesArePositive() && test.nothingMeets();
}

}  // namespace luxo
