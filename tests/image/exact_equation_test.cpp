// SPDX-License-Identifier: Apache-2.0
// Surfaces that are found by their equations, however they are placed and from whichever side, held against
// the ground truth.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "reference/reference.h"
#include "reference/verification.h"
#include "support/picture.h"
#include "surface/catalogue.h"

namespace luxo::test {
namespace {

constexpr PixelSize kSize{160, 160};
const char* const kNames[] = {"rectangle",
                              "disk",
                              "cylinder",
                              "cone",
                              "sphere",
                              "ellipsoid",
                              "paraboloid",
                              "torus",
                              "hyperboloid",
                              "hyperboloid2",
                              "hyperbolic_paraboloid"};

class ExactEquation : public PictureTest {
 protected:
  /// Whether every pixel is as good as an exact picture's must be.
  void expectTheTruth(const Scene& scene) {
    const Snapshot snapshot = takeSnapshot(scene, 0, kSize);
    const auto show = [&](Output output) {
      return renderer().render(snapshot, {.shading = Shading::Exact, .output = output});
    };
    const Picture color = show(Output::Color);
    EXPECT_EQ(color.statistics.error.unconvergedPx, 0U);
    EXPECT_EQ(color.statistics.count.shadersCompiled, 0U);
    const Verification found = verify(snapshot, castPicture(snapshot),
                                      {.color = color.image,
                                       .normal = show(Output::Normal).image,
                                       .uv = show(Output::Uv).image,
                                       .id = show(Output::Id).image});
    EXPECT_GT(found.coverage.both, 400U);
    EXPECT_EQ(found.coverage.beyond, 0U) << "coverage wrong farther than 0.01 px from the silhouette";
    EXPECT_LE(found.positionPx.max, 1e-3);
    EXPECT_GE(found.color.psnrLinear, 110);
    EXPECT_EQ(found.nanPixels, 0U);
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
  for (const char* name : kNames)
    for (const Vec3& scale : {Vec3(1), Vec3(1.2, 0.5, -0.8)})
      for (const Camera& camera : {above, below, parallel}) {
        SCOPED_TRACE(fmt::format("{}, scaled by {} in y, from x = {}", name, scale.y, camera.eye.at({}).x));
        const Node node{.rotation = Rotation{{1, 2, 0.5}, 0.7}, .scale = scale, .surface = makeSurface(name)};
        expectTheTruth(lit(node, camera));
      }
}

// An end of a rod, and a ball, flattened across: a tolerance in pixels is one across, too.
TEST_F(ExactEquation, ScaledUnevenly) {
  for (const char* name : {"cylinder", "sphere", "torus", "cone"})
    for (const double roll : {0.0, 1.5707963}) {
      SCOPED_TRACE(fmt::format("{}, rolled by {}", name, roll));
      const Node node{
          .rotation = Rotation{{0, 0, 1}, roll}, .scale = Vec3(0.3, 3, 0.3), .surface = makeSurface(name)};
      expectTheTruth(lit(node, {.eye = Vec3(0.5, 1, 6)}));
    }
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
      expectTheTruth(lit(node, {.eye = Vec3(0, 0, 4.5)}));
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
  expectTheTruth(lit({.surface = ball}, {.eye = Vec3(0, 1, 2)}));
}

}  // namespace
}  // namespace luxo::test
