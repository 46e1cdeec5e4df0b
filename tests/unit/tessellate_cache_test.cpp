// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "surface/library.h"
#include "tessellate/mesh_cache.h"

namespace luxo {
namespace {

MeshDesc grid(std::uint32_t u, std::uint32_t v) { return {.uniform = Segments{u, v}}; }

TEST(ToleranceLevel, IsThePowerOfSqrt2AtOrBelow) {
  EXPECT_EQ(toleranceLevel(1), 1);
  EXPECT_EQ(toleranceLevel(0.9), std::numbers::sqrt2 / 2);
  EXPECT_EQ(toleranceLevel(1.4), 1);
  EXPECT_EQ(toleranceLevel(1.5), std::numbers::sqrt2);
  EXPECT_EQ(toleranceLevel(3), 2 * std::numbers::sqrt2);
  EXPECT_EQ(toleranceLevel(0.5), 0.5);
  for (double tolerance = 1e-12; tolerance < 1e12; tolerance *= 1.0037) {
    const double level = toleranceLevel(tolerance);
    EXPECT_LE(level, tolerance);
    EXPECT_GT(level * std::numbers::sqrt2, tolerance * (1 - 1e-15));
    const double power = 2 * std::log2(level);
    EXPECT_NEAR(power, std::round(power), 1e-13);
  }
}

TEST(ToleranceLevel, IsItsOwnLevelAndNeverAboveItsTolerance) {
  for (int k = -200; k <= 200; ++k) {
    const double level = toleranceLevel(std::exp2(k / 2.0) * 1.01);
    EXPECT_EQ(toleranceLevel(level), level) << k;
    const double below = std::nextafter(level, 0.0);
    EXPECT_LE(toleranceLevel(below), below) << k;
    EXPECT_LT(toleranceLevel(below), 0.8 * level) << k;
  }
  double before = 0;
  for (double tolerance = 1e-3; tolerance < 1e3; tolerance *= 1.01) {
    EXPECT_GE(toleranceLevel(tolerance), before);
    before = toleranceLevel(tolerance);
  }
  EXPECT_EQ(toleranceLevel(std::numeric_limits<double>::infinity()), std::numeric_limits<double>::infinity());
  EXPECT_EQ(toleranceLevel(0), 0);
}

TEST(MeshCache, TheSameKeyIsTheSameMesh) {
  MeshCache cache;
  const Surface ball = sphere(1), copy = ball, other = sphere(2);
  const auto mesh = cache.get(ball, {}, grid(20, 10));
  EXPECT_EQ(cache.tessellated(), 1u);
  EXPECT_EQ(cache.get(ball, {}, grid(20, 10)), mesh);
  EXPECT_EQ(cache.get(copy, {}, grid(20, 10)), mesh);
  EXPECT_EQ(cache.tessellated(), 1u);
  EXPECT_NE(cache.get(ball, {}, grid(20, 11)), mesh);
  EXPECT_NE(cache.get(ball, {}, grid(10, 20)), mesh);
  EXPECT_NE(cache.get(other, {}, grid(20, 10)), mesh);
  EXPECT_EQ(cache.tessellated(), 4u);
  EXPECT_EQ(cache.get(ball, {}, grid(20, 10)), mesh);
}

TEST(MeshCache, ALevelIsOneMesh) {
  MeshCache cache;
  const Surface ball = sphere(1);
  const auto mesh = cache.get(ball, {}, {.tolerance = 0.0115});
  EXPECT_LE(mesh->bound, toleranceLevel(0.0115));
  EXPECT_EQ(cache.get(ball, {}, {.tolerance = 0.0125}), mesh);
  EXPECT_NE(cache.get(ball, {}, {.tolerance = 0.02}), mesh);
  EXPECT_NE(cache.get(ball, {}, {.tolerance = 0.0115, .longestEdge = 0.1}), mesh);
  EXPECT_EQ(cache.get(ball, {}, {.tolerance = 0.0121}), mesh);
  EXPECT_EQ(cache.tessellated(), 3u);
  // What is kept between levels does not show: a fresh cache makes the same mesh.
  EXPECT_EQ(MeshCache().get(ball, {}, {.tolerance = 0.02})->positions,
            cache.get(ball, {}, {.tolerance = 0.02})->positions);
}

TEST(MeshCache, GivesWhatTheTessellatorMakes) {
  MeshCache cache;
  const Surface s = flag();
  const std::vector<double> parameters{0.5};
  const auto cached = cache.get(s, parameters, grid(16, 1));
  const Mesh mesh = tessellate(s, parameters, grid(16, 1));
  EXPECT_EQ(cached->positions, mesh.positions);
  EXPECT_EQ(cached->indices, mesh.indices);
  EXPECT_EQ(cached->bound, mesh.bound);
}

TEST(MeshCache, ParametersBelongToTheKey) {
  MeshCache cache;
  const Surface s = flag();
  const auto at = [&](double phase) { return cache.get(s, std::vector{phase}, grid(16, 1)); };
  const auto mesh = at(0);
  EXPECT_NE(at(0.1), mesh);
  EXPECT_EQ(at(0), mesh);
  EXPECT_EQ(cache.tessellated(), 2u);
}

/// What a cache of one mesh has, of a plate of n x 1.
std::size_t bytesOfPlate(std::uint32_t n) {
  MeshCache cache;
  static_cast<void>(cache.get(rectangle(1, 1), {}, grid(n, 1)));
  return cache.bytes();
}

TEST(MeshCache, CountsBytes) {
  // A cell more has two vertices more, of a position, a normal and (u, v), and two triangles.
  const std::size_t cell = 2 * (2 * sizeof(Vec3) + sizeof(Vec2)) + 6 * sizeof(std::uint32_t);
  EXPECT_EQ(bytesOfPlate(99), bytesOfPlate(9) + 90 * cell);
  EXPECT_GT(bytesOfPlate(1), 10 * cell) << "small meshes have a surface, too";
}

TEST(MeshCache, ForgetsTheLeastRecentlyUsedBeyondItsBudget) {
  MeshCache cache(bytesOfPlate(99) + bytesOfPlate(98) + 100);
  const Surface plate = rectangle(1, 1);
  const auto ask = [&](std::uint32_t n) { static_cast<void>(cache.get(plate, {}, grid(n, 1))); };
  ask(99);
  ask(98);
  EXPECT_EQ(cache.bytes(), bytesOfPlate(99) + bytesOfPlate(98));
  ask(99);
  ask(97);  // 98 is the oldest now
  EXPECT_EQ(cache.bytes(), bytesOfPlate(99) + bytesOfPlate(97));
  EXPECT_EQ(cache.tessellated(), 3u);
  ask(99);
  ask(97);
  EXPECT_EQ(cache.tessellated(), 3u);
  ask(98);
  EXPECT_EQ(cache.tessellated(), 4u);
}

TEST(MeshCache, KeepsWhatIsInUse) {
  MeshCache cache(1);
  const Surface plate = rectangle(1, 1);
  const auto a = cache.get(plate, {}, grid(99, 1)), b = cache.get(plate, {}, grid(98, 1));
  EXPECT_EQ(cache.get(plate, {}, grid(99, 1)), a) << "a picture of both would make each of them again";
  EXPECT_EQ(cache.get(plate, {}, grid(98, 1)), b);
  EXPECT_EQ(cache.tessellated(), 2u);
}

TEST(MeshCache, KeepsTheMeshJustAskedForWhateverItsSize) {
  MeshCache cache(1);
  const Surface plate = rectangle(1, 1);
  const auto mesh = cache.get(plate, {}, grid(50, 50));
  EXPECT_EQ(mesh->positions.size(), 51u * 51);
  EXPECT_EQ(cache.get(plate, {}, grid(50, 50)), mesh);
  EXPECT_EQ(cache.tessellated(), 1u);
}

TEST(MeshCache, NeverMistakesANewSurfaceForADeadOne) {
  // The cache keeps the surface of a key alive, so that no address is used twice.
  MeshCache cache;
  for (int i = 1; i <= 50; ++i) {
    const auto mesh = cache.get(rectangle(i, 1), {}, grid(1, 1));
    EXPECT_EQ(mesh->positions[0].x, -i / 2.0);
  }
  EXPECT_EQ(cache.tessellated(), 50u);
}

TEST(MeshCache, WhatIsAllInUseIsNotLookedThroughForEachMore) {
  MeshCache cache(0);
  const Surface plate = rectangle(1, 1);
  std::vector<std::shared_ptr<const Mesh>> used;
  for (std::uint32_t n = 1; n <= 1000; ++n) used.push_back(cache.get(plate, {}, grid(n, 1)));
  // A look through all at 1, 5/4, 25/16 ... of all: five times as many in sum, if all were as large.
  EXPECT_LT(cache.lookedAt(), 10u * 1000u);
  const std::size_t bytes = cache.bytes();
  used.clear();
  for (std::uint32_t n = 1; n <= 1000; ++n) static_cast<void>(cache.get(plate, {}, grid(n, 2)));
  EXPECT_LT(cache.bytes(), bytes / 100);  // and what is idle then goes
}

}  // namespace
}  // namespace luxo
