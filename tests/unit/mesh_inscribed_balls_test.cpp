// SPDX-License-Identifier: Apache-2.0
// Balls inside of meshes hold no point of them, are inside, and are where there is room.
#include "mesh/inscribed_balls.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "mesh/mesh_solid.h"
#include "scene_test_support.h"
#include "support/meshes.h"
#include "surface/library.h"

namespace luxo::test {
namespace {

/// A ball with dents and bumps.
TriangleMesh dented(const TriangleMesh& ball, Random& random) {
  MeshArrays arrays;
  const double dents = random.uniform(0.05, 0.6), waves = 1 + random.below(5);
  for (std::uint32_t i = 0; i < ball.positions().size(); ++i) {
    const Vec3 p = ball.point(i);
    arrays.positions.push_back((1 + dents * std::sin(waves * p.x + 3 * p.y) * std::cos(waves * p.z)) * p +
                               Vec3(7, -3, 2));
  }
  arrays.indices.assign(ball.indices().begin(), ball.indices().end());
  return triangleMesh(std::move(arrays), "dented");
}

Vec3 inTriangle(const TriangleMesh& mesh, std::uint32_t triangle, Random& random) {
  const double u = std::sqrt(random.uniform(0, 1)), v = random.uniform(0, 1);
  const auto at = mesh.indices().subspan(std::size_t{3} * triangle, 3);
  return (1 - u) * mesh.point(at[0]) + u * (1 - v) * mesh.point(at[1]) + u * v * mesh.point(at[2]);
}

TEST(InscribedBalls, HoldNothingOfTheMeshWhichGoesAroundThem) {
  Random random(3);
  std::vector<TriangleMesh> meshes{icosphere(4), meshOf(torus(0.7, 0.25), 1e-3), cubeMesh(),
                                   meshOf(torus(0.8, 0.06), 1e-4)};
  for (int i = 0; i < 6; ++i) meshes.push_back(dented(icosphere(4), random));
  for (const TriangleMesh& mesh : meshes) {
    ASSERT_TRUE(boundsSolid(mesh));
    const std::vector<Sphere> balls = inscribedBalls(mesh);
    ASSERT_FALSE(balls.empty());
    for (const Sphere& ball : balls) {
      for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t)
        for (int k = 0; k < 4; ++k)
          ASSERT_GT(glm::distance(inTriangle(mesh, t, random), ball.center), ball.radius);
      for (int k = 0; k < 8; ++k) {
        const Vec3 point = ball.center + 0.99 * ball.radius * random.direction();
        const std::optional<int> times = windingNumber(mesh, {}, point, 1e-12);
        ASSERT_TRUE(!times || *times == 1);
      }
    }
  }
}

TEST(InscribedBalls, AreAsLargeAsThereIsRoom) {
  const std::vector<Sphere> balls = inscribedBalls(icosphere(5));
  ASSERT_EQ(balls.size(), 1U);
  EXPECT_GT(balls[0].radius, 0.99);
}

/// So close together that a tenth of the tube is between them and its surface.
TEST(InscribedBalls, FillATube) {
  constexpr double kMajor = 0.8, kMinor = 0.1;
  const std::vector<Sphere> balls = inscribedBalls(meshOf(torus(kMajor, kMinor), 1e-4));
  EXPECT_LT(balls.size(), 2 * kTau * kMajor / kMinor);
  for (const Sphere& ball : balls) EXPECT_NEAR(ball.radius, kMinor, 0.06 * kMinor);
  for (int i = 0; i < 1000; ++i) {
    const double angle = kTau * i / 1000;
    const Vec3 middle(kMajor * std::cos(angle), 0, kMajor * std::sin(angle));
    EXPECT_TRUE(std::ranges::any_of(balls, [&](const Sphere& ball) {
      return glm::distance(ball.center, middle) < 0.8 * kMinor;
    })) << i;
  }
}

}  // namespace
}  // namespace luxo::test
