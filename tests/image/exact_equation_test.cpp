// SPDX-License-Identifier: Apache-2.0
// Surfaces that are found by their equations, however they are placed and from whichever side, held against
// the ground truth.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

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

Scene lit(const Node& node, const Camera& camera) {
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
        expectIsRight(lit(node, camera));
      }
}

// An end of a rod, and a ball, flattened across: a tolerance in pixels is one across, too.
TEST_F(ExactEquation, ScaledUnevenly) {
  for (const char* name : {"cylinder", "sphere", "torus", "cone"})
    for (const double roll : {0.0, 1.5707963}) {
      SCOPED_TRACE(fmt::format("{}, rolled by {}", name, roll));
      const Node node{
          .rotation = Rotation{{0, 0, 1}, roll}, .scale = Vec3(0.3, 3, 0.3), .surface = makeSurface(name)};
      expectIsRight(lit(node, {.eye = Vec3(0.5, 1, 6)}));
    }
}

// Of a cone seen along its axis, a ray's distance from the axis is the only number that matters, and near the
// apex it is a hundredth of what its equation is made of: the normal turns with what is lost of it.
TEST_F(ExactEquation, NormalsBesideAnApex) {
  const Scene scene = lit({.surface = cone(1, 0, 2)}, {.eye = Vec3(0, 6, 0), .up = Vec3(0, 0, 1)});
  const Verified found = verified(takeSnapshot(scene, 0, {512, 512}));
  EXPECT_LE(found.verification.normalDegrees.max, 0.01);
}

// The apex of a cone, on the ray of a pixel's centre.
TEST_F(ExactEquation, AnApexHasAResidual) {
  Scene scene = lit({.surface = cone(1, 0, 1)}, {.eye = Vec3(0, 5, 0), .up = Vec3(0, 0, 1)});
  const FrameError error =
      renderer().render(takeSnapshot(scene, 0, {65, 65}), {.shading = Shading::Exact}).statistics.error;
  EXPECT_LE(error.residualMaxPx.value(), 1e-3);
}

// Rays pass by thin and thick tubes, along and across, and meet them farther on.
TEST_F(ExactEquation, ToriOfAllKinds) {
  for (const double minor : {0.03, 0.3, 0.6, 0.97})
    for (const double turn : {0.2, 0.9, 1.4, 1.55}) {
      SCOPED_TRACE(fmt::format("tube {}, turned by {}", minor, turn));
      const Node node{.rotation = Rotation{{1, 0, 0.2}, turn}, .surface = torus(1, minor)};
      expectIsRight(lit(node, {.eye = Vec3(0, 0, 4.5)}));
    }
}

// The near plane cuts into the slab around the surface: sides are searched for that rays do not meet in it.
TEST_F(ExactEquation, EyeBesideATorus) {
  const Surface ring = torus(1, 0.4);
  for (int k = 0; k < 12; ++k) {
    const double u = std::fmod(0.1 + k / 1.32471795724474602596, 1.0), v = k / 12.0,
                 distance = k % 2 ? 0.05 : 0.025;
    const Vec3 point = ring.position(0, u, v), normal = ring.normal(0, u, v);
    const Vec3 along = unit(glm::cross(normal, Vec3(std::sin(7 * u), 1, std::cos(7 * u))));
    const Vec3 eye = point + distance * normal;
    SCOPED_TRACE(fmt::format("{}: from ({}, {}, {})", k, eye.x, eye.y, eye.z));
    const Camera camera{
        .eye = eye, .lookAt = eye + along - 0.3 * normal, .fovY = radians(45), .near = distance};
    expectTheTruth(takeSnapshot(lit({.surface = ring}, camera), 0, {96, 72}), 400);
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
  expectIsRight(lit({.surface = ball}, {.eye = Vec3(0, 1, 2)}));
}

}  // namespace
}  // namespace luxo::test
