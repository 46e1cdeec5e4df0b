// SPDX-License-Identifier: Apache-2.0
// The promise of a mesh: its bound, measured against the true surface; and that it takes few triangles.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

#include "surface_samples.h"
#include "tessellate/block_plan.h"
#include "tessellate/tessellator.h"
#include "tessellate_measure.h"

namespace luxo {
namespace {

constexpr double kTolerances[] = {1, 0.1, 0.01, 0.001};
/// Rounding of points near 3 and of their distance to a thin triangle: what a bound of zero (a plane) leaves.
constexpr double kBoundRounding = 1e-14;

/// Distance from a point to a triangle (Ericson, Real-Time Collision Detection, 5.1.5).
double distance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap), d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
  const double d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
  const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
  if (d1 <= 0 && d2 <= 0) return glm::length(ap);
  if (d3 >= 0 && d4 <= d3) return glm::length(bp);
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return glm::length(ap - d1 / (d1 - d3) * ab);
  if (d6 >= 0 && d5 <= d6) return glm::length(cp);
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return glm::length(ap - d2 / (d2 - d6) * ac);
  if (va <= 0 && d4 >= d3 && d5 >= d6) return glm::length(bp - (d4 - d3) / (d4 - d3 + d5 - d6) * (c - b));
  return glm::length(ap - (vb * ab + vc * ac) / (va + vb + vc));
}

TEST(Bound, IsNeverExceeded) {
  for (const SurfaceSample& sample : surfaceSamples())
    for (const double tolerance : kTolerances) {
      const Mesh mesh = tessellate(sample.surface, sample.parameters, {.tolerance = tolerance});
      const double measured = largestDistance(pairsOf(sample.surface, sample.parameters, mesh, 8));
      EXPECT_LE(mesh.bound, tolerance) << sample.name;
      EXPECT_LE(measured, mesh.bound + kBoundRounding) << sample.name << " at tolerance " << tolerance;
      std::printf("%-16s tolerance %-6g %7zu triangles, measured / bound = %.3f\n", sample.name.c_str(),
                  tolerance, mesh.triangleCount(), mesh.bound > 0 ? measured / mesh.bound : 0);
    }
}

TEST(Bound, HoldsForAnySegments) {
  for (const SurfaceSample& sample : surfaceSamples())
    for (const Segments& wanted : {Segments{1, 1}, {2, 9}, {31, 2}, {5, 40}}) {
      const Mesh mesh = tessellate(sample.surface, sample.parameters, {.uniform = wanted});
      EXPECT_LE(largestDistance(pairsOf(sample.surface, sample.parameters, mesh, 8)),
                mesh.bound + kBoundRounding)
          << sample.name << ", " << wanted.u << " x " << wanted.v;
      if (wanted.u >= 3 && wanted.v >= 3) {
        EXPECT_NEAR(mesh.bound, deviationBound(sample.surface, sample.parameters, wanted), 1e-8 * mesh.bound);
      }
    }
}

TEST(Bound, NoPointOfTheSurfaceIsFartherFromTheMesh) {
  // Any triangle counts, so this does not depend on which point stands for which.
  std::mt19937 random(3);
  for (const SurfaceSample& sample : surfaceSamples()) {
    const Mesh mesh = tessellate(sample.surface, sample.parameters, {.tolerance = 0.02});
    const Domain& d = sample.surface.domain();
    std::uniform_real_distribution<double> u(d.u.lo, d.u.hi), v(d.v.lo, d.v.hi);
    for (int k = 0; k < 300; ++k) {
      const Vec3 p = sample.surface.position(u(random), v(random), sample.parameters);
      double nearest = std::numeric_limits<double>::infinity();
      for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
        const std::uint32_t* i = &mesh.indices[3 * t];
        nearest =
            std::min(nearest, distance(p, mesh.positions[i[0]], mesh.positions[i[1]], mesh.positions[i[2]]));
      }
      ASSERT_LE(nearest, mesh.bound + kBoundRounding) << sample.name;
    }
  }
}

TEST(Bound, CirclesDeviateByTheirSagitta) {
  // r (1 - cos(pi / n)), reached in the middle of every side; the bound's leading term is r pi^2 / 2 n^2.
  const double r = 0.5;
  const Surface tube = cylinder(r, 3);
  for (const std::uint32_t n : {3u, 4u, 20u, 257u}) {
    const Mesh mesh = tessellate(tube, {}, {.uniform = Segments{n, 1}});
    const double sagitta = r * (1 - std::cos(kPi / n));
    EXPECT_NEAR(largestDistance(pairsOf(tube, {}, mesh)), sagitta, 1e-15);
    EXPECT_LE(sagitta, mesh.bound);
    EXPECT_LE(mesh.bound, 1.1 * r * kPi * kPi / (2 * n * n));
  }
}

TEST(Bound, SphereMeshesAreAsFarOffAsCounted) {
  // Unit sphere, M x M/2 segments: the largest gap tends to pi^2 / M^2; three values counted independently.
  const SurfaceSample ball{.name = "ball", .surface = sphere(1)};
  for (const auto& [m, gap] : {std::pair{20u, 0.0242}, {64u, 0.00240}, {256u, 1.5e-4}}) {
    const Mesh mesh = tessellate(ball.surface, {}, {.uniform = Segments{m, m / 2}});
    double lowest = 1;
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
      const std::uint32_t* i = &mesh.indices[3 * t];
      lowest = std::min(lowest,
                        distance(Vec3(0), mesh.positions[i[0]], mesh.positions[i[1]], mesh.positions[i[2]]));
    }
    EXPECT_NEAR(1 - lowest, gap, 0.01 * gap) << m;
    EXPECT_LE(1 - lowest, mesh.bound);
  }
}

/// Triangles of the blocks: what their mesh will have, but for a few at their borders.
double triangles(const std::vector<Block>& blocks) {
  double sum = 0;
  for (const Block& block : blocks) sum += 2.0 * block.segments.u * block.segments.v;
  return sum;
}

TEST(Adaptive, StraightDirectionsTakeOneSegment) {
  for (const double tolerance : {1.0, 1e-3, 1e-6, 1e-12, 1e-300}) {
    EXPECT_EQ(tessellate(rectangle(3, 2), {}, {.tolerance = tolerance}).triangleCount(), 2u);
    for (const Surface& s :
         {cylinder(0.5, 3), cone(1.5, 0.5, 2), cone(0, 1.5, 2), disk(2), flag(), flag({.waves = 1})}) {
      const std::vector<double> parameters(s.parameters().size(), 0.3);
      const Mesh mesh = tessellate(s, parameters, {.tolerance = tolerance});
      for (const Vec2& p : mesh.parameters) ASSERT_TRUE(p.y == 0 || p.y == 1) << s.name() << " " << tolerance;
    }
  }
  // A circle of 400 px within half a pixel: pi sqrt(r / 2e) = 62.8, so 63 sides, and not many more by the
  // bound.
  const std::size_t sides = tessellate(cylinder(400, 1), {}, {.tolerance = 0.5}).triangleCount() / 2;
  EXPECT_GE(sides, 63u);
  EXPECT_LE(sides, 66u);
}

TEST(Adaptive, TakesNoMoreTrianglesThanTheBestGrid) {
  for (const SurfaceSample& sample : surfaceSamples())
    for (const double tolerance : {0.3, 0.05, 0.01}) {
      const Mesh mesh = tessellate(sample.surface, sample.parameters, {.tolerance = tolerance});
      const auto collapsed = [](Edge edge) { return edge == Edge::Pole || edge == Edge::Apex; };
      const int poles = collapsed(sample.vMin) + collapsed(sample.vMax);
      std::size_t best = std::numeric_limits<std::size_t>::max();
      for (std::uint32_t u = sample.u == Edge::Seam ? 3 : 1; u <= 300; ++u)
        for (std::uint32_t v = sample.vMin == Edge::Seam ? 3 : poles == 2 ? 2 : 1; v <= 300; ++v) {
          const std::size_t count = u * (2 * v - poles);
          if (count >= best) break;
          if (deviationBound(sample.surface, sample.parameters, {u, v}) <= tolerance) best = count;
        }
      // Both know the suprema within 10 %, one of them perhaps better than the other.
      EXPECT_LE(mesh.triangleCount(), 1.1 * best + 2) << sample.name << " at tolerance " << tolerance;
    }
}

TEST(Adaptive, SavesTrianglesWhereTheBendingVaries) {
  // Unit sphere: circles of latitude need fewer segments near the poles. A grid takes pi^2 / e triangles, cut
  // into infinitely thin bands it is the mean of sqrt(cos) over the latitudes, 0.763, of that.
  const double tolerance = 1e-4, grid = kPi * kPi / tolerance;
  const double found =
      static_cast<double>(tessellate(sphere(1), {}, {.tolerance = tolerance}).triangleCount());
  EXPECT_LT(found, 0.87 * grid);
  EXPECT_GT(found, 0.763 * grid);
}

TEST(Adaptive, AFinerLevelTakesMoreTriangles) {
  // But for what a border between blocks costs, of which a coarser level may have more.
  for (const SurfaceSample& sample : surfaceSamples()) {
    const CurvatureMap map(sample.surface, sample.parameters);
    double before = 0;
    for (double tolerance = 2; tolerance > 1e-6; tolerance /= std::sqrt(2)) {
      const double now =
          triangles(planBlocks(sample.surface, sample.parameters, map, {.tolerance = tolerance}));
      ASSERT_GE(now, 0.95 * before - 4) << sample.name << " at tolerance " << tolerance;
      before = now;
    }
  }
}

TEST(Adaptive, StopsAtTheMost) {
  for (const SurfaceSample& sample : surfaceSamples()) {
    const CurvatureMap map(sample.surface, sample.parameters);
    const std::vector<Block> blocks =
        planBlocks(sample.surface, sample.parameters, map, {.tolerance = 1e-300});
    EXPECT_LE(triangles(blocks), 1.5 * kMaxTriangles) << sample.name;
    for (const Block& block : blocks) {
      EXPECT_LE(block.segments.u, kMaxSegments);
      EXPECT_LE(block.segments.v, kMaxSegments);
      EXPECT_TRUE(std::isfinite(block.bound));
    }
  }
  for (const double tolerance : {1e300, std::numeric_limits<double>::infinity()})
    EXPECT_EQ(tessellate(sphere(1), {}, {.tolerance = tolerance}).triangleCount(), 6u);
}

TEST(Adaptive, EdgesAreAsShortAsAskedFor) {
  // A flat plate needs no vertices for its shape.
  const Mesh mesh = tessellate(rectangle(3, 2), {}, {.longestEdge = 0.25});
  EXPECT_EQ(mesh.triangleCount(), 2u * 12 * 8);
  EXPECT_EQ(tessellate(rectangle(3, 2), {}, {.longestEdge = 1e-6}).triangleCount(), 2u * 128 * 128);
}

TEST(AdaptiveDeath, WantsAPositiveTolerance) {
  const Surface ball = sphere(1);
  EXPECT_DEATH(static_cast<void>(tessellate(ball, {}, {.tolerance = 0})), "tolerance");
  EXPECT_DEATH(static_cast<void>(tessellate(ball, {}, {.tolerance = std::nan("")})), "tolerance");
}

}  // namespace
}  // namespace luxo
