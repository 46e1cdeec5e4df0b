// SPDX-License-Identifier: Apache-2.0
// Certified rays at triangles: against all triangles one by one, and where no ray may slip through.
#include "reference/triangle_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>

#include "math/transform.h"
#include "support/meshes.h"
#include "surface/surface.h"

namespace luxo::reference {
namespace {

using test::cubeMesh;
using test::icosphere;
using test::quadMesh;

TriangleTree treeOf(const TriangleMesh& mesh) { return TriangleTree(*Surface(mesh).triangles()); }

/// By volumes in long double, triangle by triangle: nothing of the tree. `near`: some edge is within 1e-12 of
/// the ray.
struct BruteHit {
  std::optional<double> t;
  bool near = false;
};
BruteHit bruteForce(const TriangleMesh& mesh, const Transform& place, const Ray& ray,
                    const RootQuery& query) {
  using Real = long double;
  using Wide = glm::vec<3, Real>;
  BruteHit hit;
  const Wide o(ray.origin), d(ray.direction);
  for (std::uint32_t i = 0; i < mesh.triangleCount(); ++i) {
    Wide p[3];
    for (std::uint32_t k = 0; k < 3; ++k)
      p[k] = Wide(transformPoint(place, mesh.point(mesh.indices()[3 * i + k]))) - o;
    Real volumes[3], size = 0;
    for (int k = 0; k < 3; ++k) {
      volumes[k] = glm::dot(d, glm::cross(p[(k + 1) % 3], p[(k + 2) % 3]));
      size = std::max(size, glm::dot(p[k], p[k]));
    }
    const Real least = std::min({volumes[0], volumes[1], volumes[2]}),
               most = std::max({volumes[0], volumes[1], volumes[2]});
    if (least < -1e-12L * size && most > 1e-12L * size) continue;
    for (const Real volume : volumes) hit.near |= std::abs(volume) <= 1e-12L * size;
    const Real sum = volumes[0] + volumes[1] + volumes[2];
    const auto t = static_cast<double>(
        (volumes[0] * glm::dot(p[0], d) + volumes[1] * glm::dot(p[1], d) + volumes[2] * glm::dot(p[2], d)) /
        sum);
    // Counter-clockwise toward the eye, turned by a mirror.
    const bool front = (sum < 0) != mirrors(place);
    if (query.facing == Facing::Front && !front) continue;
    if (t >= query.nearest && t <= query.farthest && (!hit.t || t < *hit.t)) hit.t = t;
  }
  return hit;
}

// Random rays at soups, closed and thin meshes, placed far away, flattened and mirrored; fronts and both
// sides.
TEST(ReferenceTriangles, AreThoseThatBruteForceFinds) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto vector = [&] { return Vec3(any(random), any(random), any(random)); };
  int hits = 0, misses = 0, unsettled = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const TriangleMesh mesh = trial % 4 == 0   ? icosphere(2)
                              : trial % 4 == 1 ? cubeMesh()
                                               : test::soup(random, 60, trial % 4 == 2 ? 0.5 : 0.02);
    const TriangleTree tree = treeOf(mesh);
    const double away = trial % 5 == 0 ? 1e4 : 1;
    const Transform place = compose(away * vector(), rotation(vector(), any(random)),
                                    Vec3(trial % 3 == 1 ? -1 : 1, trial % 7 == 3 ? 1e-3 : 1, 1) +
                                        0.3 * vector() * Vec3(1, trial % 7 == 3 ? 0 : 1, 1));
    for (int k = 0; k < 200; ++k) {
      const Vec3 target = transformPoint(place, vector()), from = target + 3.0 * vector();
      const Ray ray{from, unit(target - from)};
      const RootQuery query{0.1, k % 2 == 0 ? 2.5 : 100.0, k % 3 == 0 ? Facing::Front : Facing::Both,
                            mirrors(place)};
      const Roots roots = nearestRoot(tree, {ray, place}, query);
      const BruteHit brute = bruteForce(mesh, place, ray, query);
      if (brute.near) {
        ++unsettled;
        continue;
      }
      EXPECT_TRUE(roots.certified);
      ASSERT_EQ(roots.nearest.has_value(), brute.t.has_value()) << "trial " << trial << ", ray " << k;
      if (!brute.t) {
        ++misses;
        continue;
      }
      ++hits;
      EXPECT_NEAR(roots.nearest->t, *brute.t, 1e-9 * away);
      const auto [a, b, c] = tree.triangles().points(roots.nearest->patch);
      const double u = roots.nearest->u, v = roots.nearest->v;
      EXPECT_LT(glm::distance(transformPoint(place, (1 - u - v) * a + u * b + v * c),
                              ray.origin + roots.nearest->t * ray.direction),
                1e-9 * away);
    }
  }
  EXPECT_GT(hits, 1000);
  EXPECT_GT(misses, 1000);
  EXPECT_LT(unsettled, 20);
}

// Through edges and corners that triangles share: no ray slips through, and each is certain.
TEST(ReferenceTriangles, RaysAtSharedEdgesAndCornersHitForCertain) {
  const TriangleMesh mesh = icosphere(2);
  const TriangleTree tree = treeOf(mesh);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(0, 1);
  for (std::uint32_t i = 0; i < mesh.triangleCount(); ++i) {
    const Vec3 a = mesh.point(mesh.indices()[3 * i]), b = mesh.point(mesh.indices()[3 * i + 1]);
    for (const double part : {0.0, 0.5, any(random)}) {
      // From the middle of the ball, and from outside toward it.
      const Vec3 at = glm::mix(a, b, part), way = unit(at);
      for (const Ray& ray : {Ray{Vec3(0), way}, Ray{2.0 * at, -way}}) {
        const Roots roots = nearestRoot(tree, {ray, {}}, {1e-3, 100});
        ASSERT_TRUE(roots.nearest) << i << ", " << part;
        EXPECT_TRUE(roots.certified) << i << ", " << part;
        EXPECT_NEAR(roots.nearest->t, glm::length(at), 1e-12);
      }
    }
  }
}

TEST(ReferenceTriangles, BordersAndOutlinesWithinRoundingAreUndecided) {
  const TriangleTree quad = treeOf(quadMesh()), cube = treeOf(cubeMesh());
  const auto toward = [](const TriangleTree& tree, double x, double y) {
    return nearestRoot(tree, {{{x, y, 5}, {0, 0, -1}}, {}}, {0, 100});
  };
  for (const double part : {-0.5, 0.0, 0.3}) {
    EXPECT_TRUE(toward(quad, part, part).certified);  // on the diagonal that both triangles have
    EXPECT_TRUE(toward(quad, part, part).nearest);
    EXPECT_FALSE(toward(quad, 1, part).certified);
    EXPECT_TRUE(toward(quad, 1 + 1e-12, part).certified);
    EXPECT_FALSE(toward(quad, 1 + 1e-12, part).nearest);
    EXPECT_TRUE(toward(quad, 1 - 1e-12, part).nearest);
    EXPECT_FALSE(toward(cube, 1, part).certified);  // along a face
    EXPECT_TRUE(toward(cube, 1 - 1e-12, part).certified);
  }
  EXPECT_FALSE(nearestRoot(quad, {{{0, 0, 5}, unit(Vec3(1, 1, -5))}, {}}, {0, 100}).certified);  // a corner
}

TEST(ReferenceTriangles, WhatHidesAnOutlineSettlesIt) {
  MeshArrays arrays{.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-3, -3, 1}, {3, -3, 1}, {0, 5, 1}},
                    .indices = {0, 1, 2, 3, 4, 5}};
  const TriangleTree tree = treeOf(triangleMesh(std::move(arrays)));
  EXPECT_TRUE(nearestRoot(tree, {{{1, 0, 5}, {0, 0, -1}}, {}}, {0, 100}).certified);
  EXPECT_FALSE(nearestRoot(tree, {{{1, 0, -5}, {0, 0, 1}}, {}}, {0, 100}).certified);
}

// An icosphere is inside of its sphere, by no more than its edges' sagitta; a torus's mesh by its bound.
TEST(ReferenceTriangles, AreAsFarFromTheSurfaceAsTheirBoundAllows) {
  const TriangleTree ball = treeOf(icosphere(3));
  const double sagitta = 1 - std::sqrt(1 - 0.1 * 0.1);  // circumradii are below 0.1: edges of 0.14 to 0.165
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int k = 0; k < 500; ++k) {
    const Vec3 way = unit(Vec3(any(random), any(random), any(random)));
    const Roots roots = nearestRoot(ball, {{3.0 * way, -way}, {}}, {0, 100});
    ASSERT_TRUE(roots.nearest);
    const double radius = 3 - roots.nearest->t;
    EXPECT_LE(radius, 1 + 1e-7);  // corners are rounded to float
    EXPECT_GE(radius, 1 - sagitta);
  }
}

}  // namespace
}  // namespace luxo::reference
