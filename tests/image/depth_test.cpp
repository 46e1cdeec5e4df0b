// SPDX-License-Identifier: Apache-2.0
// What hides what: plates that almost touch, near and far, and what crosses the plane of the eye.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "support/picture.h"

namespace luxo::test {
namespace {

using Depth = PictureTest;

const Vec3 kNearRed(1, 0, 0), kFarGreen(0, 1, 0);

/// Draws two plates, the red one nearer, either the red or the green one first. The order of draws is the
/// renderer's, front to back: a third, nearer plate beside the picture's middle, that shares its draw with
/// the one wanted first, pulls it forward.
Image plates(Renderer& renderer, const Camera& camera, PixelSize size, double depth, double gap, double tilt,
             bool greenFirst) {
  Scene scene;
  scene.set(plainSettings());
  Material red = glowing(kNearRed), green = glowing(kFarGreen);
  (greenFirst ? green : red).shading = Shading::Flat;
  const double wide = 4 * depth;
  const auto add = [&](double z, const Material& material) {
    Node node = plate(Vec3(0, 0, -z), Vec2(wide), scene.add(material));
    node.rotation = Rotation{{1, 0, 0}, kPi / 2 + tilt};
    scene.add(std::move(node));
  };
  // The gap is measured along the view axis.
  add(depth, red);
  add(depth + gap, green);
  // The decoy has the surface of the plates, hence their mesh, and is scaled down to a corner of the picture.
  const Material decoy = greenFirst ? green : red;
  const CameraModel model(camera, size);
  Node corner = plate(model.through({1.5, 1.5}).at(depth / 4), Vec2(wide), scene.add(decoy));
  corner.scale = Vec3(2 * depth / 4 / model.pixelsPerUnit() / wide);
  scene.add(std::move(corner));
  return renderer.render(takeSnapshot(scene, 0, size, camera)).image;
}

TEST_F(Depth, PlatesAMillimetreApartNeverFight) {
  constexpr PixelSize kSize{128, 128};
  struct Case {
    double depth, gap, tilt;
  };
  // 90 m and 1 km: the millimetre is 1.2e-7 and 1e-9 of reversed depth, 130 and 8 steps of a float there.
  // Tilted, a vertex snapped by 1/512 px shifts depth by tan(tilt) z / (512 f): 0.2 mm of the millimetre.
  const double f = 640;
  for (const Case& c : {Case{90, 1e-3, 0}, Case{1000, 1e-3, 0}, Case{90, 1e-3, 0.6}})
    for (const bool greenFirst : {false, true}) {
      const Camera camera{.eye = Vec3(0), .lookAt = Vec3(0, 0, -1), .fovY = 2 * std::atan(64 / f), .near = 1};
      const Image image = plates(renderer(), camera, kSize, c.depth, c.gap, c.tilt, greenFirst);
      for (int y = 4; y < kSize.height; ++y)
        for (int x = 4; x < kSize.width; ++x)
          ASSERT_EQ(colorAt(image, x, y), kNearRed) << c.depth << " m, " << (greenFirst ? "green" : "red")
                                                    << " drawn first, (" << x << ", " << y << ")";
    }
}

/// The plate must cover exactly the pixels whose rays meet it beyond the near plane; edges may move by the
/// snap.
void expectAnalyticMask(const Image& image, const CameraModel& model, double near, const Mat3& worldFromPlate,
                        const Vec3& center, const Vec2& size, const Vec3& color) {
  const auto inside = [&](const Vec2& pixel) {
    const Ray ray = model.through(pixel);
    const auto depth = hitPlane(ray, center, worldFromPlate[1]);
    if (!depth || *depth < near) return false;
    const Vec3 q = ray.at(*depth) - center;
    return std::abs(glm::dot(q, worldFromPlate[0])) <= size.x / 2 &&
           std::abs(glm::dot(q, worldFromPlate[2])) <= size.y / 2;
  };
  int covered = 0, bare = 0, atEdge = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const auto expected = settled(inside, centerOf(x, y), kSnapPx);
      if (!expected) {
        ++atEdge;
        continue;
      }
      ++(*expected ? covered : bare);
      ASSERT_EQ(colorAt(image, x, y), *expected ? color : Vec3(0)) << x << ", " << y;
    }
  EXPECT_GT(covered, 500);
  EXPECT_GT(bare, 500);
  EXPECT_LT(atEdge, (covered + bare) / 100);
}

TEST_F(Depth, WhatCrossesTheEyePlaneIsTheClippedPolygon) {
  constexpr PixelSize kSize{256, 192};
  struct Case {
    Vec3 axis;
    double angle;
    Vec3 center;
    Vec2 size;
  };
  // Floors and walls that pass beside, below and behind the eye, in every attitude; two triangles each, with
  // up to three of four corners behind the eye.
  const std::array cases{
      Case{{0, 1, 0}, 0.4, {0.5, -1, 1}, {6, 30}}, Case{{1, 0, 0.3}, 0.7, {0.4, -1.5, 0}, {5, 12}},
      Case{{0.2, 1, 1}, 1.1, {1.5, -0.4, -1}, {8, 8}}, Case{{1, 2, -0.7}, 2.0, {-0.9, 0.6, 0.5}, {9, 3}},
      Case{{0, 0, 1}, 1.3, {2, 0, -100}, {3000, 4000}}};
  const Camera camera{.eye = Vec3(0),
                      .lookAt = Vec3(0.1, -0.2, -1),
                      .up = Vec3(0.3, 1, 0),
                      .fovY = radians(60),
                      .near = 0.05};
  for (const Case& c : cases) {
    Scene scene;
    scene.set(plainSettings());
    scene.add(Node{.translation = c.center,
                   .rotation = Rotation{c.axis, c.angle},
                   .surface = rectangle(c.size.x, c.size.y),
                   .material = scene.add(glowing(kFarGreen))});
    SCOPED_TRACE(testing::Message() << "center.x = " << c.center.x);
    expectAnalyticMask(draw(scene, camera, kSize).image, CameraModel(camera, kSize), camera.near.at(0),
                       rotation(c.axis, c.angle), c.center, c.size, kFarGreen);
  }
}

TEST_F(Depth, AnyPictureSize) {
  for (const PixelSize size : {PixelSize{1, 1}, PixelSize{3, 5}, PixelSize{641, 359}}) {
    Scene scene;
    scene.set(plainSettings());
    scene.add(plate(Vec3(0.2, 0.1, 0), {1.6, 1.2}, scene.add(glowing(kNearRed))));
    const Camera camera{.eye = Vec3(0, 0, 3), .fovY = radians(45)};
    const Image image = draw(scene, camera, size).image;
    ASSERT_EQ(image.width(), size.width);
    ASSERT_EQ(image.height(), size.height);
    ASSERT_EQ(image.channels(), 3);
    const CameraModel model(camera, size);
    for (int y = 0; y < size.height; ++y)
      for (int x = 0; x < size.width; ++x) {
        const auto inside = settled(
            [&](const Vec2& pixel) {
              const Vec3 q = model.through(pixel).at(3);
              return std::abs(q.x - 0.2) <= 0.8 && std::abs(q.y - 0.1) <= 0.6;
            },
            centerOf(x, y), kSnapPx);
        if (!inside) continue;
        ASSERT_EQ(colorAt(image, x, y), *inside ? kNearRed : Vec3(0)) << x << ", " << y;
      }
  }
}

TEST_F(Depth, NothingCloserThanTheNearPlaneIsSeen) {
  Scene scene;
  scene.set(plainSettings());
  scene.add(plate(Vec3(0, 0, -0.999), Vec2(10), scene.add(glowing(kNearRed))));
  scene.add(plate(Vec3(0, 0, -1.001), Vec2(10), scene.add(glowing(kFarGreen))));
  const Camera camera{.eye = Vec3(0), .lookAt = Vec3(0, 0, -1), .near = 1};
  EXPECT_EQ(colorAt(draw(scene, camera, {9, 9}).image, 4, 4), kFarGreen);
}

}  // namespace
}  // namespace luxo::test
