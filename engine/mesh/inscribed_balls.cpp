// SPDX-License-Identifier: Apache-2.0
#include "mesh/inscribed_balls.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "mesh/mesh_solid.h"

namespace luxo {
namespace {

constexpr std::size_t kMaxBalls = 256;
/// Places that balls are looked for at, and how many at a time.
constexpr std::uint32_t kPlaces = 1024, kAtATime = 16;
/// Without a ball, after which no more are looked at: there is little room anywhere.
constexpr std::uint32_t kMaxVain = 128;
/// Of the bounds' diagonal: smaller ones hide little.
constexpr double kLeastRadius = 1.0 / 128;
/// Of a ball's radius: at a place that close to it much the same ball would be found. Along a tube they are
/// then 0.9 radii apart, and a tenth of its width is beside them.
constexpr double kClose = 0.1;
constexpr int kGrowingSteps = 8;
constexpr int kMaxSteps = 24;       // about eight are taken
constexpr double kTouches = 0.999;  // of the radius: nothing is much nearer than the place itself
/// Of the bounds' diagonal: what rounding may leave of a distance, that to slivers lower than that included.
constexpr double kRounding = 0x1p-22;

Vec3 nearestOfEdge(const Vec3& a, const Vec3& b, const Vec3& p) {
  const Vec3 way = b - a;
  return a + std::clamp(glm::dot(p - a, way) / glm::dot(way, way), 0.0, 1.0) * way;
}

/// The point of a triangle that is nearest to p: of its edges, or where p is above its inside. Of slivers,
/// whose planes rounding turns, it is off by no more than their height, or too near.
Vec3 nearestOf(const std::array<Vec3, 3>& t, const Vec3& p) {
  const Vec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
  bool isAbove = true;
  Vec3 nearest(0);
  double least = std::numeric_limits<double>::infinity();
  const auto take = [&](const Vec3& q) {
    if (const double squared = glm::dot(q - p, q - p); squared < least) {
      least = squared;
      nearest = q;
    }
  };
  for (int k = 0; k < 3; ++k) {
    const Vec3 &a = t[k], &b = t[(k + 1) % 3];
    isAbove = isAbove && glm::dot(glm::cross(b - a, p - a), normal) >= 0;
    take(nearestOfEdge(a, b, p));
  }
  if (isAbove) take(p - glm::dot(p - t[0], normal) / glm::dot(normal, normal) * normal);
  return nearest;
}

class BallFinder {
 public:
  explicit BallFinder(const TriangleMesh& mesh)
      : mesh_(mesh), diagonal_(glm::length(mesh.bounds().extent())) {}

  struct Place {
    Vec3 point, inward;
  };

  /// In the order of the golden section, which leaves no large gaps among the mesh's triangles.
  [[nodiscard]] Place placeOf(std::uint32_t number) const {
    const double part = std::fmod(number * (std::numbers::phi - 1), 1.0);
    const auto triangle = static_cast<std::uint32_t>(part * mesh_.triangleCount());
    const auto t = cornersOf(std::min(triangle, mesh_.triangleCount() - 1));
    return {(t[0] + t[1] + t[2]) / 3.0, -unit(glm::cross(t[1] - t[0], t[2] - t[0]))};
  }

  /// The largest that touches the mesh there, or one that is not much smaller.
  [[nodiscard]] Sphere ballAt(const Place& place) const {
    double radius = diagonal_ / 2;
    for (int step = 0; step < kMaxSteps; ++step) {
      const Vec3 center = place.point + radius * place.inward;
      // Any point in the ball makes it smaller.
      const Vec3 inside = nearestTo(center, kTouches * radius), chord = inside - place.point;
      const double along = glm::dot(chord, place.inward);
      if (glm::distance(inside, center) >= kTouches * radius || !(along > 0)) break;
      radius = glm::dot(chord, chord) / (2 * along);  // of the ball that touches the place, through the point
    }
    return grown(place.point + radius * place.inward);
  }

  [[nodiscard]] bool isUseful(const Sphere& ball) const {
    // All of a ball is on one side of the mesh; lines from its middle would meet edges of what is symmetric.
    const Vec3 point = ball.center + ball.radius * Vec3(0.31, -0.17, 0.23);
    return ball.radius >= kLeastRadius * diagonal_ &&
           windingNumber(mesh_, {}, point, kRounding * diagonal_).value_or(0) > 0;
  }

 private:
  [[nodiscard]] std::array<Vec3, 3> cornersOf(std::uint32_t triangle) const {
    const auto at = mesh_.indices().subspan(std::size_t{3} * triangle, 3);
    return {mesh_.point(at[0]), mesh_.point(at[1]), mesh_.point(at[2])};
  }

  /// One that touches a facet beside its middle is too small by the same part however fine the mesh: away
  /// from what it touches there is more room.
  [[nodiscard]] Sphere grown(Vec3 center) const {
    Vec3 nearest = nearestTo(center);
    double radius = glm::distance(nearest, center), way = radius / 4;
    for (int step = 0; step < kGrowingSteps; ++step) {
      const Vec3 moved = center + way * unit(center - nearest), next = nearestTo(moved, radius);
      if (const double room = glm::distance(next, moved); room > radius) {
        center = moved;
        nearest = next;
        radius = room;
      } else {
        way /= 2;
      }
    }
    return {center, radius - kRounding * diagonal_};
  }

  /// Of the mesh; or any point of it that is nearer than `enough`.
  [[nodiscard]] Vec3 nearestTo(const Vec3& p, double enough = 0) const {
    const std::span<const MeshCluster> clusters = mesh_.clusters();
    const auto distanceTo = [&](const Box& box) {
      const Vec3 beside = glm::max(glm::max(box.min - p, p - box.max), Vec3(0));
      return glm::dot(beside, beside);
    };
    std::vector<double> distances(clusters.size());
    std::ranges::transform(clusters, distances.begin(),
                           [&](const MeshCluster& cluster) { return distanceTo(cluster.bounds); });
    double least = std::numeric_limits<double>::infinity();
    Vec3 nearest(0);
    const auto look = [&](std::size_t i) {
      for (std::uint32_t t = 0; t < clusters[i].triangles; ++t) {
        const Vec3 q = nearestOf(cornersOf(clusters[i].firstTriangle + t), p), way = q - p;
        if (const double squared = glm::dot(way, way); squared < least) {
          least = squared;
          nearest = q;
        }
      }
    };
    look(static_cast<std::size_t>(std::ranges::min_element(distances) - distances.begin()));
    for (std::size_t i = 0; i < distances.size() && !(least < enough * enough); ++i)
      if (distances[i] < least) look(i);
    return nearest;
  }

  const TriangleMesh& mesh_;
  double diagonal_;
};

}  // namespace

std::vector<Sphere> inscribedBalls(const TriangleMesh& mesh) {
  const BallFinder finder(mesh);
  std::vector<Sphere> balls;
  const auto isCloseToOne = [&](const BallFinder::Place& place) {
    return std::ranges::any_of(balls, [&](const Sphere& ball) {
      return glm::distance(place.point, ball.center) < (1 + kClose) * ball.radius;
    });
  };
  std::uint32_t vain = 0;
  for (std::uint32_t first = 0; first < kPlaces && vain < kMaxVain && balls.size() < kMaxBalls;
       first += kAtATime) {
    std::vector<BallFinder::Place> places;
    for (std::uint32_t i = first; i < first + kAtATime; ++i)
      if (const auto place = finder.placeOf(i); !isCloseToOne(place)) places.push_back(place);
    std::vector<std::optional<Sphere>> found(places.size());
    tbb::this_task_arena::isolate([&] {
      tbb::parallel_for(std::size_t{0}, places.size(), [&](std::size_t i) {
        if (const Sphere ball = finder.ballAt(places[i]); finder.isUseful(ball)) found[i] = ball;
      });
    });
    for (std::size_t i = 0; i < places.size(); ++i) {
      vain = found[i] ? 0 : vain + 1;
      if (found[i] && !isCloseToOne(places[i])) balls.push_back(*found[i]);
    }
  }
  return balls;
}

}  // namespace luxo
