// SPDX-License-Identifier: Apache-2.0
// Exact shading where a view magnifies what float rounds away: shaders that compute in double.
#include <gtest/gtest.h>

#include <cmath>

#include "support/picture.h"

namespace luxo::test {
namespace {

constexpr PixelSize kExactDoubleSize{64, 64};
constexpr double kBallRadius = 0.7;  // no float

class ExactDouble : public PictureTest {
 protected:
  void SetUp() override {
    PictureTest::SetUp();
    if (!IsSkipped() && !HasFatalFailure() && !context().features().float64)
      GTEST_SKIP() << "no doubles in shaders";
  }
};

/// A ball that is not where floats are, seen as through a telescope: the picture's height is `height` metres
/// at the target.
const Vec3 kCenter(0.1, -0.2, 0.3);
const Vec3 kEye(0, 0, 4);

Camera telescope(const Vec3& target, double height) {
  return {.eye = kEye, .lookAt = target, .fovY = 2 * std::atan(0.5 * height / glm::length(target - kEye))};
}

Scene ball(Material material) {
  Scene scene;
  scene.set(plainSettings());
  scene.add(Node{
      .translation = kCenter, .surface = sphere(kBallRadius), .material = scene.add(std::move(material))});
  return scene;
}

/// A point of the ball's outline.
Vec3 onOutline() {
  const Vec3 toEye = kEye - kCenter;
  const double distance = glm::length(toEye), cosine = kBallRadius / distance;
  const Vec3 axis = toEye / distance, across = unit(glm::cross(axis, Vec3(1, 2, 3)));
  return kCenter + kBallRadius * (cosine * axis + std::sqrt(1 - cosine * cosine) * across);
}

TEST_F(ExactDouble, OutlinesAreSharpHoweverNear) {
  const Scene scene = ball(glowing(Vec3(0, 1, 0)));
  for (const double height : {1e-3, 1e-5}) {
    SCOPED_TRACE(height);
    const Camera camera = telescope(onOutline(), height);
    const CameraModel model(camera, kExactDoubleSize);
    const auto inside = [&](const Vec2& pixel) {
      return hitSphere(model.through(pixel), kCenter, kBallRadius).has_value();
    };
    const Picture picture = draw(scene, camera, kExactDoubleSize);
    int covered = 0;
    for (int y = 0; y < kExactDoubleSize.height; ++y)
      for (int x = 0; x < kExactDoubleSize.width; ++x) {
        const bool shown = colorAt(picture.image, x, y).y > 0;
        covered += shown;
        if (const auto truth = settled(inside, centerOf(x, y), 0.01)) {
          ASSERT_EQ(shown, *truth) << x << ", " << y;
        }
      }
    // The outline passes through the middle.
    EXPECT_GT(covered, kExactDoubleSize.width * kExactDoubleSize.height / 4);
    EXPECT_LT(covered, kExactDoubleSize.width * kExactDoubleSize.height * 3 / 4);
    EXPECT_LE(picture.statistics.error.residualMaxPx.value_or(1), 1e-3);
    EXPECT_EQ(picture.statistics.error.unconvergedPx, 0u);
  }
}

// What is read back is float: two roundings of 2^-24.
TEST_F(ExactDouble, DepthsAreRight) {
  const Vec3 target = kCenter + kBallRadius * unit(Vec3(0.3, 0.2, 1));
  const Camera camera = telescope(target, 1e-4);
  const CameraModel model(camera, kExactDoubleSize);
  const Image depth = draw(ball(glowing(Vec3(1))), camera, kExactDoubleSize, {.output = Output::Depth}).image;
  for (int y = 0; y < kExactDoubleSize.height; ++y)
    for (int x = 0; x < kExactDoubleSize.width; ++x) {
      const double truth = hitSphere(model.through(centerOf(x, y)), kCenter, kBallRadius)->first;
      ASSERT_NEAR(depth.pixel(x, y)[0], truth, 2 * 0x1p-24 * truth) << x << ", " << y;
    }
}

TEST_F(ExactDouble, PatternsAreShown) {
  const Pattern shown = pattern([](auto u, auto v) { return point(0.1 * u, 0.3 * v + 0.5, 0.5); });
  const Scene scene = ball({.specular = Vec3(0), .diffusePattern = shown});
  const Camera camera = telescope(kCenter + kBallRadius * unit(Vec3(0.3, 0.2, 1)), 1e-4);
  const Image color = draw(scene, camera, kExactDoubleSize).image;
  const Image uv = draw(scene, camera, kExactDoubleSize, {.output = Output::Uv}).image;
  for (int y = 0; y < kExactDoubleSize.height; ++y)
    for (int x = 0; x < kExactDoubleSize.width; ++x) {
      const auto p = uv.pixel(x, y);
      // A few roundings of numbers up to 1.
      ASSERT_TRUE(near(colorAt(color, x, y), Vec3(0.1 * p[0], 0.3 * p[1] + 0.5, 0.5), 1e-6))
          << x << ", " << y;
    }
}

// From 70 km single precision moves a shell's vertices by most of such a pixel.
TEST_F(ExactDouble, EdgesAreSharpHoweverFar) {
  Scene scene;
  scene.set(plainSettings());
  const double half = 0.5 * kBallRadius;
  scene.add(Node{.translation = kCenter,
                 .surface = rectangle(2 * half, 2 * half),
                 .material = scene.add(glowing(Vec3(0, 1, 0)))});
  const Surface sheet =
      surface([](auto u, auto v) { return point(u, 0.0 * u, v); }, {{-half, half}, {-half, half}});
  Scene ofFormula;
  ofFormula.set(plainSettings());
  ofFormula.add(
      Node{.translation = kCenter, .surface = sheet, .material = ofFormula.add(glowing(Vec3(0, 1, 0)))});
  const Vec3 corner = kCenter + Vec3(half, 0, half), eye = Vec3(-40e3, 50e3, 30e3);
  for (const double height : {1e-1, 1e-2, 1e-3}) {
    const Camera camera{
        .eye = eye, .lookAt = corner, .fovY = 2 * std::atan(0.5 * height / glm::length(corner - eye))};
    const CameraModel model(camera, kExactDoubleSize);
    const auto inside = [&](const Vec2& pixel) {
      const Ray ray = model.through(pixel);
      const Vec3 hit = ray.at(hitPlane(ray, kCenter, Vec3(0, 1, 0)).value()) - kCenter;
      return std::abs(hit.x) < half && std::abs(hit.z) < half;
    };
    for (const Scene* shown : {&scene, &ofFormula}) {
      SCOPED_TRACE(testing::Message() << height << (shown == &scene ? "" : ", formula"));
      const Picture picture = draw(*shown, camera, kExactDoubleSize);
      for (int y = 0; y < kExactDoubleSize.height; ++y)
        for (int x = 0; x < kExactDoubleSize.width; ++x) {
          if (const auto truth = settled(inside, centerOf(x, y), 0.02)) {
            ASSERT_EQ(colorAt(picture.image, x, y).y > 0, *truth) << x << ", " << y;
          }
        }
      EXPECT_EQ(picture.statistics.error.resolvedByRaysPx, 0u);
    }
  }
}

TEST_F(ExactDouble, WithoutItTheReportTellsOfALargerError) {
  const Scene scene = ball(glowing(Vec3(1)));
  const Camera camera = telescope(kCenter + Vec3(0, 0, kBallRadius), 8e-2);
  const FrameError with = draw(scene, camera, kExactDoubleSize).statistics.error;
  const FrameError without = draw(scene, camera, kExactDoubleSize, {.doubles = false}).statistics.error;
  EXPECT_LE(with.residualMaxPx.value_or(1), 1e-5);
  // A pixel is 1.2e-3 m, of which 2^-24 of the ball's size is 3e-5: less than where nothing is certified.
  EXPECT_GT(without.residualMaxPx.value_or(0), 1e-5);
  EXPECT_EQ(without.resolvedByRaysPx, 0u);
}

// Single precision moves points of the sheet by up to 2^-24 of 300, a hundredth of such pixels: and no
// residual tells, as it is computed with the same numbers.
TEST_F(ExactDouble, WithoutItNoPointIsCertifiedThatAFormulasRoundingMoves) {
  Scene scene;
  scene.set(plainSettings());
  const Surface sheet =
      surface([](auto u, auto v) { return point(u, 0.2 * sin(8.0 * u + 300.0), v); }, {{-1, 1}, {-1, 1}});
  scene.add(Node{.surface = sheet, .material = scene.add(glowing(Vec3(1)))});
  const Camera camera{.eye = Vec3(0.4, 1.5, 0.3), .lookAt = Vec3(0), .up = Vec3(0, 0, 1), .fovY = 0.12};
  const Audit none{.extent = AuditExtent::None};
  const Picture picture = draw(scene, camera, kExactDoubleSize, {.doubles = false, .audit = none});
  EXPECT_EQ(picture.statistics.error.resolvedByRaysPx,
            static_cast<std::uint64_t>(kExactDoubleSize.width * kExactDoubleSize.height));
  EXPECT_EQ(picture.statistics.error.unconvergedPx, 0U);
  EXPECT_EQ(picture.statistics.error.uncertifiedPx, 0U);
}

TEST_F(ExactDouble, WithoutItWhatFloatWouldLoseAtEdgesIsFoundByRays) {
  const Scene scene = ball(glowing(Vec3(1)));
  const Camera camera = telescope(kCenter + Vec3(0, 0, kBallRadius), 1e-4);
  const FrameError error = draw(scene, camera, kExactDoubleSize, {.doubles = false}).statistics.error;
  EXPECT_EQ(error.resolvedByRaysPx,
            static_cast<std::uint64_t>(kExactDoubleSize.width * kExactDoubleSize.height));
  EXPECT_EQ(error.unconvergedPx, 0u);
}

}  // namespace
}  // namespace luxo::test
