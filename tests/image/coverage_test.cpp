// SPDX-License-Identifier: Apache-2.0
// Which pixels, and how much of them: silhouettes against the promised error bound, and the four samples of
// MSAA.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "support/picture.h"

namespace luxo::test {
namespace {

using Coverage = PictureTest;

const Vec3 kWhite(1);

TEST_F(Coverage, SilhouetteIsWithinTheTolerance) {
  constexpr PixelSize kSize{240, 180};
  struct Case {
    Vec3 center;
    double radius;
  };
  // In the middle, where the outline is a circle; in a corner, where it is an ellipse; close to the eye.
  for (const Case& c : {Case{{0, 0, -6}, 2}, Case{{2.2, 1.6, -7}, 1}, Case{{-0.4, 0.3, -2.2}, 1.2}}) {
    const Camera camera{.eye = Vec3(0), .lookAt = Vec3(0, 0, -1), .fovY = radians(60)};
    const CameraModel model(camera, kSize);
    const auto inside = [&](const Vec2& p) {
      return hitSphere(model.through(p), c.center, c.radius).has_value();
    };
    std::uint64_t trianglesBefore = 0;
    for (const double tolerance : {4.0, 1.0, 0.25}) {
      SCOPED_TRACE(testing::Message() << "tolerance " << tolerance << ", centre x " << c.center.x);
      Scene scene;
      scene.set(plainSettings());
      scene.add(
          Node{.translation = c.center, .surface = sphere(c.radius), .material = scene.add(glowing(kWhite))});
      const Picture picture =
          draw(scene, camera, kSize, {.shading = Shading::Phong, .tolerancePx = tolerance});
      EXPECT_LE(picture.statistics.error.boundPx, tolerance);
      EXPECT_GT(picture.statistics.error.boundPx, 0);
      EXPECT_EQ(picture.statistics.error.tolerancePx, tolerance);
      EXPECT_GT(picture.statistics.count.triangles, trianglesBefore);
      trianglesBefore = picture.statistics.count.triangles;

      // The mesh is inscribed: it may lack pixels near the outline but never adds any.
      double drawn = 0, exact = 0, border = 0;
      for (int y = 0; y < kSize.height; ++y)
        for (int x = 0; x < kSize.width; ++x) {
          const bool shown = colorAt(picture.image, x, y) == kWhite;
          const Vec2 center = centerOf(x, y);
          drawn += shown;
          exact += inside(center);
          border += !settled(inside, center, 0.5);
          if (shown == inside(center)) continue;
          ASSERT_FALSE(settled(inside, center, picture.statistics.error.boundPx + kSnapPx)) << x << ", " << y;
          ASSERT_FALSE(shown && settled(inside, center, kSnapPx)) << x << ", " << y;
        }
      EXPECT_GT(exact, 1000);
      // The outline is about `border` pixels long.
      EXPECT_LE(std::abs(drawn - exact), border * tolerance);
    }
  }
}

/// Vulkan's standard places of four samples in a pixel.
constexpr std::array kSamples{Vec2(0.375, 0.125), Vec2(0.875, 0.375), Vec2(0.125, 0.625), Vec2(0.625, 0.875)};

TEST_F(Coverage, FourSamplesCountQuarters) {
  constexpr PixelSize kSize{96, 80};
  // A plate turned by 17 degrees in the picture's plane: 20 pixels per metre, edges of every slope's parity.
  const double angle = radians(17);
  Scene scene;
  scene.set(plainSettings());
  Node node = plate(Vec3(0.013, -0.027, 0), {3, 2}, scene.add(glowing(kWhite)));
  const NodeId turned = scene.add(Node{.rotation = Rotation{{0, 0, 1}, angle}});
  node.parent = turned;
  scene.add(node);
  const Camera camera{.eye = Vec3(0, 0, 5), .projection = Projection::Orthographic, .height = 4};
  const CameraModel model(camera, kSize);
  const auto inside = [&](const Vec2& pixel) {
    const Vec3 p = model.through(pixel).at(5);
    const double x = p.x * std::cos(angle) + p.y * std::sin(angle) - 0.013;
    const double y = -p.x * std::sin(angle) + p.y * std::cos(angle) + 0.027;
    return std::abs(x) <= 1.5 && std::abs(y) <= 1;
  };
  const Image four = draw(scene, camera, kSize, {.samples = 4}).image;
  const Image one = draw(scene, camera, kSize).image;

  constexpr int kGrid = 64;  // exact coverage to 1 % by 4096 points
  double squaredFour = 0, squaredOne = 0, areaFour = 0;
  int partial = 0, samplesAtEdge = 0;
  for (int y = 0; y < kSize.height; ++y)
    for (int x = 0; x < kSize.width; ++x) {
      const Vec3 color = colorAt(four, x, y);
      const double quarters = std::round(4 * color.x);
      // A mean of four pictures: each moves it by less than 1e-7 (draw/accumulation.h).
      ASSERT_NEAR(quarters / 4, color.x, 4e-7) << x << ", " << y;
      partial += quarters != 0 && quarters != 4;
      areaFour += color.x;

      int least = 0, most = 0;
      for (const Vec2& sample : kSamples) {
        const auto covered = settled(inside, Vec2(x, y) + sample, kSnapPx);
        least += covered == true;
        most += covered != false;
      }
      samplesAtEdge += most - least;
      ASSERT_GE(quarters, least) << x << ", " << y;
      ASSERT_LE(quarters, most) << x << ", " << y;

      double exact = 0;
      if (const auto whole = settled(inside, centerOf(x, y), 0.75)) {
        exact = *whole;
      } else {
        for (int j = 0; j < kGrid; ++j)
          for (int i = 0; i < kGrid; ++i) exact += inside(Vec2(x + (i + 0.5) / kGrid, y + (j + 0.5) / kGrid));
        exact /= kGrid * kGrid;
      }
      squaredFour += (color.x - exact) * (color.x - exact);
      squaredOne += (colorAt(one, x, y).x - exact) * (colorAt(one, x, y).x - exact);
    }
  EXPECT_GT(partial, 100);
  EXPECT_LT(samplesAtEdge, 20);
  // One sample of an edge pixel is off by 0.29 (the deviation of an even distribution over 0..1 from the
  // nearer end); four stratified ones by no more than half of that.
  EXPECT_LT(std::sqrt(squaredFour), 0.5 * std::sqrt(squaredOne));
  // 3 m x 2 m at 20 pixels per metre; the errors of some 200 edge pixels, 0.1 each, add up as a random walk.
  EXPECT_NEAR(areaFour, 2400, 4 * 0.1 * std::sqrt(200.0));
}

TEST_F(Coverage, LightIsFoundAtEverySample) {
  // A pixel is the mean of the formula at its four samples. A sharp highlight tells it from the formula at
  // the pixel's centre.
  constexpr PixelSize kSize{40, 30};
  const Material mirrorlike{.diffuse = Vec3(0), .ambient = Vec3(0), .specular = Vec3(1), .shininess = 3000};
  const std::array lights{Shine{.position = {0.3, 0.2, 4, 1}}};
  Scene scene;
  scene.set(RenderSettings{.background = Vec3(0), .ambient = Vec3(0)});
  scene.add(plate(Vec3(0), Vec2(20), scene.add(mirrorlike)));
  addLight(scene, lights[0]);
  const Camera camera{.eye = Vec3(0, 0, 5), .fovY = radians(40)};
  const CameraModel model(camera, kSize);
  const Image image = draw(scene, camera, kSize, {.samples = 4}).image;
  const auto formula = [&](const Vec2& pixel) {
    const Vec3 point = model.through(pixel).at(5);
    return blinnPhong(mirrorlike, Vec3(0), lights, point, {0, 0, 1}, model.towardViewer(point));
  };
  double atCenter = 0;
  for (int y = 0; y < kSize.height; ++y)
    for (int x = 0; x < kSize.width; ++x) {
      Vec3 mean(0);
      for (const Vec2& sample : kSamples) mean += 0.25 * formula(Vec2(x, y) + sample);
      // Single precision: the exponent multiplies some 3e-7 in N.H and its logarithm.
      ASSERT_TRUE(near(colorAt(image, x, y), mean, 3e-7 * mirrorlike.shininess)) << x << ", " << y;
      atCenter = std::max(atCenter, std::abs(formula(centerOf(x, y)).x - mean.x));
    }
  EXPECT_GT(atCenter, 0.01);
}

}  // namespace
}  // namespace luxo::test
