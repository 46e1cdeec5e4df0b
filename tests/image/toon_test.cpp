// SPDX-License-Identifier: Apache-2.0
// Drawings: two levels of the diffuse colour, and an outline as wide as it should be, wherever the surface
// is.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "support/picture.h"

namespace luxo::test {
namespace {

using Toon = PictureTest;

constexpr DrawOptions kToon{.shading = Shading::Toon};
const Vec3 kPaint(0.8, 0.6, 0.4);

Scene sceneOf(Node node, const Vec3& background) {
  Scene scene;
  scene.set(plainSettings(background));
  node.material = scene.add(Material{.diffuse = kPaint});
  scene.add(std::move(node));
  return scene;
}

/// The circle in which a unit sphere at the origin is seen from a point on the Z axis, pixels.
double circleRadius(const CameraModel& model, double distance) {
  const double tangentDepth = distance - 1 / distance;  // of the points where rays touch it
  return model.pixelsPerUnit() * std::sqrt(1 - 1 / (distance * distance)) / tangentDepth;
}

TEST_F(Toon, OutlineIsTwoPixelsWideAtEveryDistance) {
  constexpr PixelSize kSize{720, 720};
  // Without light all of the sphere has the darker level: a background of the same colour leaves the ink
  // alone.
  const Scene scene = sceneOf({.surface = sphere(1)}, 0.5 * kPaint);
  for (const double distance : {2.5, 8.0, 25.0}) {
    const Camera camera{.eye = Vec3(0, 0, distance), .fovY = radians(50)};
    const double radius = circleRadius(CameraModel(camera, kSize), distance);
    for (const int samples : {1, 4}) {
      const Image image = draw(scene, camera, kSize, {.shading = Shading::Toon, .samples = samples}).image;
      // Ink in sixteen sectors, in pixels of area. The outer edge of a sector is cut by pixels: their error
      // averages out over its length of at least 12 pixels.
      std::array<double, 16> ink{};
      for (int y = 0; y < kSize.height; ++y)
        for (int x = 0; x < kSize.width; ++x) {
          const Vec2 fromCenter = centerOf(x, y) - Vec2(kSize.width, kSize.height) / 2.0;
          const double amount = 1 - colorAt(image, x, y).y / (0.5 * kPaint.y);
          const double r = glm::length(fromCenter);
          if (std::abs(r - radius) > 6) {
            ASSERT_NEAR(amount, 0, 1e-6) << "ink " << radius - r << " px inside";
          }
          const double turn = std::atan2(fromCenter.y, fromCenter.x) / kTau + 0.5;
          ink[std::min(static_cast<int>(16 * turn), 15)] += amount;
        }
      for (const double area : ink)
        EXPECT_NEAR(area / (kTau * (radius - 1) / 16), 2, 0.5) << radius << " px, samples " << samples;
    }
  }
}

TEST_F(Toon, GrazingFloorsAreNeverInked) {
  constexpr PixelSize kSize{320, 180};
  for (const double height : {2.0, 0.5, 0.05, 0.005}) {
    const Camera camera{.eye = Vec3(0, height, 31), .lookAt = Vec3(0, height, 0), .fovY = radians(50)};
    const Image image = draw(sceneOf({.surface = rectangle(60, 60)}, Vec3(1)), camera, kSize, kToon).image;
    int floor = 0;
    for (int y = 0; y < kSize.height; ++y)
      for (int x = 0; x < kSize.width; ++x) {
        const Vec3 color = colorAt(image, x, y);
        floor += color != Vec3(1);
        ASSERT_GE(color.y, 0.5 * kPaint.y - 1e-6) << height << ": " << x << ", " << y;
      }
    if (height > 0.01) {
      EXPECT_GT(floor, 1000) << "the floor is in the picture";
    }
  }
}

TEST_F(Toon, ShowsTwoLevelsWithTheirBorderAtSixtyDegrees) {
  constexpr PixelSize kSize{240, 240};
  Scene scene = sceneOf({.surface = sphere(1)}, Vec3(0));
  const Vec3 sun = glm::normalize(Vec3(1, 2, 1)), lamp(-4, 1, 3);
  addLight(scene, {.position = Vec4(sun, 0), .radiance = {3, 0, 0}});
  addLight(scene, {.position = Vec4(lamp, 1), .radiance = {0.01, 0.01, 0.01}, .inverseSquare = true});
  const Camera camera{
      .eye = Vec3(0, 0, 6), .projection = Projection::Orthographic, .height = 2.4};  // 100 px a metre
  const Image image = draw(scene, camera, kSize, kToon).image;
  int full = 0, half = 0;
  for (int y = 0; y < kSize.height; ++y)
    for (int x = 0; x < kSize.width; ++x) {
      const auto bright = [&](const Vec2& pixel) {
        const double px = (pixel.x - 120) / 100, py = (120 - pixel.y) / 100;
        const Vec3 n(px, py, std::sqrt(std::max(0.0, 1 - px * px - py * py)));
        return glm::dot(n, sun) > 0.5 || glm::dot(n, glm::normalize(lamp - n)) > 0.5;
      };
      if (glm::length(centerOf(x, y) - Vec2(120, 120)) > 95) continue;  // the outline
      // The edge is a pixel wide; the mesh is up to half a pixel off, more where it turns away.
      const auto level = settled(bright, centerOf(x, y), 2.5);
      if (!level) continue;
      ++(*level ? full : half);
      ASSERT_TRUE(near(colorAt(image, x, y), kPaint * (*level ? 1.0 : 0.5), 1e-6)) << x << ", " << y;
    }
  EXPECT_GT(full, 5000);
  EXPECT_GT(half, 5000);
}

TEST_F(Toon, LongFacetsAreInkedAtTheirSilhouetteOnly) {
  // The walls of a cone are triangles as long as the cone, as narrow as a pixel near the silhouette.
  constexpr PixelSize kSize{360, 300};
  for (const double turn : {0.0, 0.3, 0.6}) {
    Node node{.translation = Vec3(0, -0.9, 0),
              .rotation = Rotation{{1, 0.3, 0}, turn},
              .surface = cone(0.9, 0.2, 1.8)};
    const Camera camera{.eye = Vec3(0, 0, 7), .fovY = radians(20)};
    const Image image = draw(sceneOf(std::move(node), Vec3(1)), camera, kSize, kToon).image;
    double ink = 0;  // pixels of area
    for (int y = 5; y < kSize.height - 5; ++y)
      for (int x = 5; x < kSize.width - 5; ++x) {
        const double amount = 1 - colorAt(image, x, y).y / (0.5 * kPaint.y);
        if (amount <= 1e-6) continue;
        ink += amount;
        bool atBorder = false;
        for (int dx = -5; dx <= 5; ++dx) atBorder = atBorder || colorAt(image, x + dx, y) == Vec3(1);
        ASSERT_TRUE(atBorder) << "ink inside at " << x << ", " << y << ", turned by " << turn;
      }
    // Two sides, each sqrt(1.8^2 + 0.7^2) m long before it is turned away, at 122 pixels a metre.
    const double lengthPx = 2 * std::hypot(1.8 * std::cos(turn), 0.7) * 122;
    EXPECT_NEAR(ink / lengthPx, 2, 0.5) << turn;
  }
}

TEST_F(Toon, HidesWhatIsBehindAndKeepsOutlinesOfHolesAndFolds) {
  // The near half of a torus seen from low above hides the lower part of the far half: there is ink between
  // the two, away from the border to the background.
  constexpr PixelSize kSize{240, 160};
  const Image image = draw(sceneOf({.surface = torus(2, 0.8)}, Vec3(1)),
                           Camera{.eye = Vec3(0, 2, 7), .fovY = radians(50)}, kSize, kToon)
                          .image;
  int inner = 0;
  for (int y = 5; y < kSize.height - 5; ++y)
    for (int x = kSize.width / 2 - 20; x < kSize.width / 2 + 20; ++x) {
      if (colorAt(image, x, y) != Vec3(0)) continue;
      bool inside = true;
      for (int dy = -5; dy <= 5; ++dy) inside = inside && colorAt(image, x, y + dy) != Vec3(1);
      inner += inside;
    }
  EXPECT_GT(inner, 20);
}

}  // namespace
}  // namespace luxo::test
