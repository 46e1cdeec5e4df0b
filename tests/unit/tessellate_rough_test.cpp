// SPDX-License-Identifier: Apache-2.0
// Surfaces with kinks, jumps and holes: the bound holds or says that it does not know, and what is drawn is
// finite.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "surface/surface.h"
#include "tessellate/block_plan.h"
#include "tessellate/tessellator.h"
#include "tessellate_measure.h"

namespace luxo {
namespace {

/// What rounding leaves of points on planes of size 1.
constexpr double kRoughRounding = 1e-14;

/// A plate of 2 x 2 whose height over (u, v) in -1..1 is the formula.
template <class Height>
Surface relief(const Height& height) {
  return surface([&](auto u, auto v) { return point(u, height(u, v), -v); }, {{-1, 1}, {-1, 1}});
}

void expectFinite(const Mesh& mesh) {
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    ASSERT_TRUE(std::isfinite(glm::length(mesh.positions[i])));
    ASSERT_NEAR(glm::length(mesh.normals[i]), 1, 1e-12);
  }
}

TEST(Kinks, AlongAParameterLineCostNothing) {
  // A roof: two planes.
  const Mesh mesh = tessellate(relief([](auto u, auto) { return -abs(u); }), {}, {.tolerance = 1e-3});
  EXPECT_LE(mesh.bound, 1e-3);
  EXPECT_LE(mesh.triangleCount(), 8u);
  expectFinite(mesh);
}

TEST(Kinks, AreCutUntilTheirBoxesAreSmall) {
  const Surface surfaces[] = {relief([](auto u, auto) { return abs(u - 0.3); }),
                              relief([](auto u, auto v) { return abs(u + 0.7 * v); }),
                              relief([](auto u, auto v) { return max(0.3 * sin(3 * u), 0.2 * cos(2 * v)); })};
  for (const Surface& surface : surfaces)
    for (const double tolerance : {0.1, 0.02, 0.005}) {
      const Mesh mesh = tessellate(surface, {}, {.tolerance = tolerance});
      EXPECT_LE(mesh.bound, tolerance);
      EXPECT_LE(largestDistance(pairsOf(surface, {}, mesh, 5)), mesh.bound + kRoughRounding);
      expectFinite(mesh);
    }
}

TEST(Kinks, BeyondTheBudgetTheBoundSaysSo) {
  const Surface surface = relief([](auto u, auto v) { return abs(u + 0.7 * v); });
  const Mesh mesh = tessellate(surface, {}, {.tolerance = 1e-6});
  EXPECT_GT(mesh.bound, 1e-6);
  EXPECT_LT(mesh.bound, 0.02);
  EXPECT_LE(largestDistance(pairsOf(surface, {}, mesh, 5)), mesh.bound + kRoughRounding);
  EXPECT_LT(mesh.triangleCount(), 40'000u);
}

TEST(Kinks, AJumpIsAsFarOffAsItIsHigh) {
  // Slanting steps of height 0.5: a triangle joins their edges, and is up to a step away from both.
  const Surface surface = relief([](auto u, auto v) { return floor(1.3 * (u + 0.4 * v)) / 2; });
  const Mesh mesh = tessellate(surface, {}, {.tolerance = 0.01});
  EXPECT_GE(mesh.bound, 0.5);
  EXPECT_LT(mesh.bound, 0.6);
  EXPECT_LE(largestDistance(pairsOf(surface, {}, mesh, 5)), mesh.bound + kRoughRounding);
  expectFinite(mesh);
}

TEST(Holes, AreLeftOut) {
  // sqrt(u^2 + v^2 - 1/4): a round hole of radius 1/2 in the middle.
  const Surface surface = relief([](auto u, auto v) { return sqrt(u * u + v * v - 0.25); });
  const Mesh mesh = tessellate(surface, {}, {.tolerance = 0.01});
  EXPECT_GT(mesh.dropped, 0u);
  expectFinite(mesh);
  double area = 0;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const std::uint32_t* i = &mesh.indices[3 * t];
    const Vec2 a = mesh.parameters[i[0]], b = mesh.parameters[i[1]] - a, c = mesh.parameters[i[2]] - a;
    area += std::abs(b.x * c.y - b.y * c.x) / 2;
    for (int k = 0; k < 3; ++k) ASSERT_GE(glm::length(mesh.parameters[i[k]]), 0.5);
  }
  // All of the square but the disk and a rim, less than a fiftieth wide, around it.
  EXPECT_LT(area, 4 - kPi / 4);
  EXPECT_GT(area, 4 - kPi * 0.52 * 0.52);
}

TEST(Holes, AFormulaWithoutValuesIsNoTriangles) {
  const Surface surface = relief([](auto u, auto v) { return log(u - 0.9) + 0 * v; });
  const Mesh mesh = tessellate(surface, {}, {.tolerance = 0.01});
  EXPECT_GT(mesh.triangleCount(), 0u);
  expectFinite(mesh);
  for (const Vec2& p : mesh.parameters) EXPECT_GT(p.x, 0.9);
}

TEST(Holes, AMeshWithoutTrianglesIsBoundless) {
  // Straight, as far as derivatives know, and without a single value once the logarithm's is none.
  const Surface plane =
      surface([](auto u, auto v, auto a) { return point(u, log(a), v); }, {{-1, 1}, {-1, 1}}, {}, 1.0);
  const double none = -1;
  const Mesh mesh = tessellate(plane, {&none, 1}, {.tolerance = 0.01});
  EXPECT_EQ(mesh.triangleCount(), 0u);
  EXPECT_TRUE(std::isinf(mesh.bound));
}

TEST(Holes, APoleOfTheFormulaIsBoundless) {
  const Surface surface = relief([](auto u, auto v) { return 0.01 / (u - 0.3) + 0 * v; });
  const Mesh mesh = tessellate(surface, {}, {.tolerance = 0.01});
  EXPECT_TRUE(std::isinf(mesh.bound));
  EXPECT_LT(mesh.triangleCount(), 40'000u);
  expectFinite(mesh);
}

TEST(Rough, GridsStayWithoutCracks) {
  // The sum of (u, v) areas is the domain's, and every inner edge has two triangles.
  const Surface surface = relief([](auto u, auto v) { return abs(u + 0.7 * v); });
  const Mesh mesh = tessellate(surface, {}, {.tolerance = 0.01});
  double area = 0;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const std::uint32_t* i = &mesh.indices[3 * t];
    const Vec2 a = mesh.parameters[i[0]], b = mesh.parameters[i[1]] - a, c = mesh.parameters[i[2]] - a;
    ASSERT_GT(b.x * c.y - b.y * c.x, 0);
    area += (b.x * c.y - b.y * c.x) / 2;
    for (int k = 0; k < 3; ++k) edges.emplace_back(i[k], i[(k + 1) % 3]);
  }
  EXPECT_NEAR(area, 4, 1e-12);
  std::sort(edges.begin(), edges.end());
  for (const auto& [a, b] : edges) {
    if (std::binary_search(edges.begin(), edges.end(), std::pair(b, a))) continue;
    const Vec2 &p = mesh.parameters[a], &q = mesh.parameters[b];
    EXPECT_TRUE((std::abs(p.x) == 1 && p.x == q.x) || (std::abs(p.y) == 1 && p.y == q.y));
  }
}

}  // namespace
}  // namespace luxo
