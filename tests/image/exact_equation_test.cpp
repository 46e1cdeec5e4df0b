// SPDX-License-Identifier: Apache-2.0
// Surfaces that are found by their equations, however they are placed and from whichever side, held against
// the ground truth.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <utility>

#include "math/sampling.h"
#include "support/equation_names.h"
#include "support/verified_picture.h"
#include "surface/catalogue.h"

namespace luxo::test {
namespace {

class ExactEquation : public VerifiedPictureTest {
 protected:
  void expectIsRight(const Scene& scene) {
    const Verified found = expectTheTruth(takeSnapshot(scene, 0, {160, 160}), 400);
    EXPECT_EQ(found.statistics.count.shadersCompiled, 0U);
  }
};

Scene litEquation(const Node& node, const Camera& camera) {
  Scene scene;
  scene.add(node);
  scene.add(Node{.translation = Vec3(2, 5, 3), .light = Light{.intensity = 0.8}});
  scene.add(camera);
  return scene;
}

TEST_F(ExactEquation, IsRightWhereverItIsAndFromBothSides) {
  const Camera above{.eye = Vec3(2, 2.5, 4)}, below{.eye = Vec3(-3, -2, 1.5)};
  const Camera parallel{.eye = Vec3(1, 2, 3), .projection = Projection::Orthographic, .height = 4};
  for (const std::string& name : kEquationNames)
    for (const Vec3& scale : {Vec3(1), Vec3(1.2, 0.5, -0.8)})
      for (const Camera& camera : {above, below, parallel}) {
        SCOPED_TRACE(fmt::format("{}, scaled by {} in y, from x = {}", name, scale.y, camera.eye.at({}).x));
        const Node node{.rotation = Rotation{{1, 2, 0.5}, 0.7}, .scale = scale, .surface = makeSurface(name)};
        expectIsRight(litEquation(node, camera));
      }
}

// An end of a rod, and a ball, flattened across: a tolerance in pixels is one across, too.
TEST_F(ExactEquation, ScaledUnevenly) {
  for (const char* name : {"cylinder", "sphere", "torus", "cone"})
    for (const double roll : {0.0, 1.5707963}) {
      SCOPED_TRACE(fmt::format("{}, rolled by {}", name, roll));
      const Node node{
          .rotation = Rotation{{0, 0, 1}, roll}, .scale = Vec3(0.3, 3, 0.3), .surface = makeSurface(name)};
      expectIsRight(litEquation(node, {.eye = Vec3(0.5, 1, 6)}));
    }
}

// From nearly level with its rim: outward is toward the eye there, and going on beyond the rim is going up.
TEST_F(ExactEquation, EndsWhereItEndsSeenFromBeside) {
  for (int i = 0; i < 12; ++i) {
    SCOPED_TRACE(i);
    const double rim = 1.9, above = 0.02 * (i - 6);
    const Camera camera{
        .eye = Vec3(0.3 * i, rim + above, 12), .lookAt = Vec3(0, rim + 0.0011 * i, 0), .fovY = radians(1)};
    const Scene scene = litEquation({.surface = paraboloid(0.32, rim)}, camera);
    EXPECT_EQ(verified(takeSnapshot(scene, 0, {96, 16})).verification.coverage.beyond, 0U);
  }
}

// What floats leave of a flat cone's heights is a hundred times as much across it.
TEST_F(ExactEquation, FlatConesEndWhereTheyEnd) {
  for (const double height : {0.1, 0.01, 0.003, 0.001, 0.0003})
    for (const double top : {0.0, 0.4}) {
      SCOPED_TRACE(fmt::format("{} high, {} wide at its top", height, top));
      const Scene scene =
          litEquation({.rotation = Rotation{{1, 0.3, 0.2}, 0.4}, .surface = cone(1, top, height)},
                      {.eye = Vec3(0, 3.2, 3.8), .fovY = radians(26)});
      const Verified found = verified(takeSnapshot(scene, 0, {400, 300}));
      EXPECT_EQ(found.verification.coverage.beyond, 0U);
      EXPECT_EQ(found.verification.wrong.total(), 0U);
    }
}

// Of a cone seen along its axis, a ray's distance from the axis is the only number that matters, and near the
// apex it is a hundredth of what its equation is made of: the normal turns with what is lost of it.
TEST_F(ExactEquation, NormalsBesideAnApex) {
  const Scene scene = litEquation({.surface = cone(1, 0, 2)}, {.eye = Vec3(0, 6, 0), .up = Vec3(0, 0, 1)});
  const Verified found = verified(takeSnapshot(scene, 0, {512, 512}));
  EXPECT_LE(found.verification.normalDegrees.max, 0.01);
}

// The apex of a cone, on the ray of a pixel's centre.
TEST_F(ExactEquation, AnApexHasAResidual) {
  Scene scene = litEquation({.surface = cone(1, 0, 1)}, {.eye = Vec3(0, 5, 0), .up = Vec3(0, 0, 1)});
  const FrameError error =
      renderer().render(takeSnapshot(scene, 0, {65, 65}), {.shading = Shading::Exact}).statistics.error;
  EXPECT_LE(error.residualMaxPx.value(), 1e-3);
}

// Nearly closed holes, threads, eyes in the hole and in the tube with rays along its inside, and telephotos
// of tangents. Of a usual view nearly every root is proven to be the first without a ray.
TEST_F(ExactEquation, ATorusIsMetNowhereBeforeTheRootThatIsShown) {
  std::mt19937 random(5);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const auto onTube = [](double u, double v, double radius) {
    const double ring = 1 + radius * std::cos(v);
    return Vec3(ring * std::cos(u), radius * std::sin(v), -ring * std::sin(u));
  };
  std::uint64_t seen = 0;
  for (const double minor : {0.9999, 0.3, 0.005}) {
    const double u = between(0, kTau), v = between(0, kTau);
    const Vec3 hole = Vec3(between(-0.3, 0.3), 2, between(-0.3, 0.3)) * (1.01 - minor);
    const Vec3 inside = onTube(u, v, between(0, 0.999) * minor);
    const Vec3 along(-std::sin(u) + between(-0.2, 0.2), between(-0.2, 0.2), -std::cos(u));
    const std::array cameras{
        Camera{.eye = hole, .lookAt = Vec3(between(-1, 1), -0.2, between(-1, 1)), .fovY = 1.4, .near = 0.002},
        Camera{.eye = inside, .lookAt = inside + along, .fovY = 1.2, .near = 0.002},
        Camera{.eye = Vec3(4, 1.001 * minor, 0), .lookAt = Vec3(0, minor, 0), .fovY = 0.05},
        Camera{.eye = Vec3(20, 30, 10), .lookAt = onTube(u, v, minor), .fovY = 0.004}};
    for (const Camera& camera : cameras) {
      SCOPED_TRACE(fmt::format("tube {}, camera {}", minor, &camera - cameras.data()));
      const Verified found =
          verified(takeSnapshot(litEquation({.surface = torus(1, minor)}, camera), 0, {64, 48}));
      EXPECT_EQ(found.verification.wrong.total(), 0U);
      EXPECT_EQ(found.statistics.error.unconvergedPx, 0U);
      seen += found.verification.coverage.both;
    }
  }
  EXPECT_GT(seen, 5'000U);
  // Beside the axis F bends many times as much: 27 and 31 pixels of narrow holes are left to rays.
  for (const auto& [minor, byRays] : {std::pair(0.97, 40U), std::pair(0.7, 40U), std::pair(0.3, 0U)}) {
    const Snapshot snapshot =
        takeSnapshot(litEquation({.surface = torus(1, minor)}, {.eye = Vec3(2, 2.5, 4)}), 0, {480, 360});
    const FrameError error = renderer().render(snapshot, {.shading = Shading::Exact}).statistics.error;
    EXPECT_LE(error.resolvedByRaysPx, byRays) << "tube " << minor;
  }
}

// Rays pass by thin and thick tubes, along and across, and meet them farther on.
TEST_F(ExactEquation, ToriOfAllKinds) {
  for (const double minor : {0.03, 0.3, 0.6, 0.97})
    for (const double turn : {0.2, 0.9, 1.4, 1.55}) {
      SCOPED_TRACE(fmt::format("tube {}, turned by {}", minor, turn));
      const Node node{.rotation = Rotation{{1, 0, 0.2}, turn}, .surface = torus(1, minor)};
      expectIsRight(litEquation(node, {.eye = Vec3(0, 0, 4.5)}));
    }
}

// The near plane cuts into the slab around the surface: sides are searched for that rays do not meet in it.
TEST_F(ExactEquation, EyeBesideATorus) {
  const Surface ring = torus(1, 0.4);
  for (int k = 0; k < 12; ++k) {
    const double u = quasirandomPoint(k, Vec2(0.1)).x, v = k / 12.0, distance = k % 2 ? 0.05 : 0.025;
    const Vec3 point = ring.position(0, u, v), normal = ring.normal(0, u, v);
    const Vec3 along = unit(glm::cross(normal, Vec3(std::sin(7 * u), 1, std::cos(7 * u))));
    const Vec3 eye = point + distance * normal;
    SCOPED_TRACE(fmt::format("{}: from ({}, {}, {})", k, eye.x, eye.y, eye.z));
    const Camera camera{
        .eye = eye, .lookAt = eye + along - 0.3 * normal, .fovY = radians(45), .near = distance};
    expectTheTruth(takeSnapshot(litEquation({.surface = ring}, camera), 0, {96, 72}), 400);
  }
}

TEST_F(ExactEquation, AFormulaIsFoundByItsEquationToo) {
  const Surface ball = surface(
      [](auto u, auto v) {
        const Expr latitude = kPi * (v - 0.5), turn = kTau * u;
        return point(0.7 * cos(latitude) * cos(turn), 0.7 * sin(latitude),
                     -(0.7 * cos(latitude) * sin(turn)));
      },
      {});
  expectIsRight(litEquation({.surface = ball}, {.eye = Vec3(0, 1, 2)}));
}

}  // namespace
}  // namespace luxo::test
