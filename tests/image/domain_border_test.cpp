// SPDX-License-Identifier: Apache-2.0
// Formulas that have no value in parts of their rectangle: the surface ends where they do, in a curve.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>

#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "support/verified_picture.h"

namespace luxo::test {
namespace {

using DomainBorderTest = VerifiedPictureTest;

constexpr PixelSize kDomainBorderSize{200, 150};

Scene plotted(const std::string& height, double half) {
  return buildScene(parseScene(R"({ "luxo": 1, "surfaces": { "s": { "type": "formula", "u": [)" +
                                   std::to_string(-half) + ", " + std::to_string(half) + R"(], "v": [)" +
                                   std::to_string(-half) + ", " + std::to_string(half) +
                                   R"(], "position": ["u", ")" + height + R"(", "-v"] } },
    "nodes": [ { "translate": [3, 6, 4], "light": {} }, { "surface": "s" } ],
    "camera": { "eye": [1.4, 1.9, 2.4], "look_at": [0, 0.2, 0], "fov_y": "45deg" } })",
                               "border"));
}

TEST_F(DomainBorderTest, HalfABallEndsInACircle) {
  const Scene scene = plotted("sqrt(1 - u^2 - v^2)", 2);
  const Snapshot snapshot = takeSnapshot(scene, 0, kDomainBorderSize);
  const Verified found = verified(snapshot);
  EXPECT_EQ(found.verification.coverage.beyond, 0U);
  EXPECT_EQ(found.verification.coverage.undecided, 0U);
  // Beside the rim, where the dome is steepest, v's rounding to float is worth 0.0073 px; positions are right
  // to 2e-5 px there, as all others.
  EXPECT_LE(found.verification.positionPx.max, 0.01);
  EXPECT_EQ(found.verification.wrong.total(), 0U);
  EXPECT_EQ(found.statistics.error.unconvergedPx, 0U);
  EXPECT_GT(found.statistics.error.resolvedByRaysPx, 5000U) << "no shell ends where the formula does";
  // Four pixels of this size are so near to the rim that v, rounded to float, is outside of the domain.
  EXPECT_EQ(verified(takeSnapshot(scene, 0, {800, 600})).verification.wrong.total(), 0U);

  // What a ray meets of the whole ball above y = 0, but where a thousandth of a pixel makes a difference.
  const CameraModel camera(scene.cameras()[0], kDomainBorderSize);
  const auto isHit = [&](const Vec2& pixel) {
    const Ray ray = camera.through(pixel);
    const auto depths = hitSphere(ray, Vec3(0), 1);
    return depths && (ray.at(depths->first).y > 0 || ray.at(depths->second).y > 0);
  };
  const Image id = renderer().render(snapshot, {.output = Output::Id}).image;
  int settledPixels = 0;
  for (int y = 0; y < kDomainBorderSize.height; ++y)
    for (int x = 0; x < kDomainBorderSize.width; ++x) {
      const auto expected = settled(isHit, centerOf(x, y), 1e-3);
      if (!expected) continue;
      ++settledPixels;
      ASSERT_EQ(id.pixel(x, y)[0] > 0, *expected) << x << ", " << y;
    }
  EXPECT_GT(settledPixels, kDomainBorderSize.width * kDomainBorderSize.height - 10);
}

/// No shell holds what has no end, and no bounds tell where to look: rays find it, at poles as elsewhere.
TEST_F(DomainBorderTest, WhatHasNoEndIsFound) {
  for (const char* height : {"log(1 - u^2 - v^2)", "1/u", "sin(8*sqrt(u^2 + v^2))/(8*sqrt(u^2 + v^2))",
                             "u*log(u + v)", "tan(2*u)"}) {
    const Verified found = verified(takeSnapshot(plotted(height, 2), 0, kDomainBorderSize));
    EXPECT_EQ(found.verification.wrong.total(), 0U) << height;
    EXPECT_GT(found.verification.coverage.both, 2000U) << height;
    // Along a pole's own plane every height is met at once.
    EXPECT_LT(found.verification.coverage.undecided, 300U) << height;
    EXPECT_EQ(found.statistics.error.boundPx, 0) << height;
    EXPECT_EQ(found.statistics.error.auditFailedPx, 0U) << height;
  }
}

TEST_F(DomainBorderTest, ARemovablePointIsFilled) {
  const Snapshot snapshot =
      takeSnapshot(plotted("sin(sqrt(u^2 + v^2))/sqrt(u^2 + v^2)", 1), 0, kDomainBorderSize);
  const Verified found = expectTheTruth(snapshot, 5000);
  EXPECT_EQ(found.verification.wrong.total(), 0U);
  // Of the square seen from above nothing is missing: no ray through it finds a way down.
  const Image id = renderer().render(snapshot, {.output = Output::Id}).image;
  const Camera camera{.eye = Vec3(0.01, 4, 0.02), .lookAt = Vec3(0.01, 0, 0.02), .fovY = radians(15)};
  const Image above = renderer()
                          .render(takeSnapshot(plotted("sin(sqrt(u^2 + v^2))/sqrt(u^2 + v^2)", 1), 0,
                                               kDomainBorderSize, camera),
                                  {.output = Output::Id})
                          .image;
  for (const float number : above.samples()) ASSERT_GT(number, 0);
}

/// Whole lines of them, and products: with the limits there the surface is as any other. What has a shell
/// needs no rays but beside outlines.
TEST_F(DomainBorderTest, RemovableLinesAreFilled) {
  for (const char* height : {"sin(u)/u", "(u^2 - v^2)/(u - v)", "sin(3*u)*sin(v)/(u*v)", "(1 - cos(2*u))/u^2",
                             "(exp(u) - 1)/(2*u)", "(1 - exp(-3*(u^2 + v^2)))/(u^2 + v^2)",
                             "sin(9*sqrt(u^2 + v^2))/(9*sqrt(u^2 + v^2))"}) {
    const Scene scene = plotted(height, 1);
    const Verified found = expectTheTruth(takeSnapshot(scene, 0, kDomainBorderSize), 1000);
    EXPECT_EQ(found.verification.wrong.total(), 0U) << height;
    EXPECT_EQ(found.statistics.error.unconvergedPx, 0U) << height;
    EXPECT_LE(found.statistics.error.resolvedByRaysPx, 100U) << height;
  }
}

}  // namespace
}  // namespace luxo::test
