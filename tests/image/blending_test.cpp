// SPDX-License-Identifier: Apache-2.0
// Transparency: over, in the right order, whatever order the scene was built in.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "support/picture.h"

namespace luxo::test {
namespace {

using Blending = PictureTest;

constexpr PixelSize kBlendingSize{48, 48};
constexpr int kMiddle = 24;
const Vec3 kRed(1, 0, 0), kGreen(0, 1, 0), kBlue(0, 0, 1);

struct Pane {
  double z;
  Vec3 color;
  double opacity;
};

Scene panes(std::span<const Pane> list, const Vec3& background = Vec3(0)) {
  Scene scene;
  scene.set(plainSettings(background));
  for (const Pane& pane : list)
    scene.add(plate(Vec3(0, 0, pane.z), Vec2(2), scene.add(glowing(pane.color, pane.opacity))));
  scene.add(Camera{.eye = Vec3(0, 0, 5), .fovY = radians(40)});
  return scene;
}

TEST_F(Blending, HalfRedOverGreen) {
  const auto middle = [&](std::span<const Pane> list, const Vec3& background = Vec3(0)) {
    return colorAt(draw(panes(list, background), kBlendingSize).image, kMiddle, kMiddle);
  };
  // over: c = a c1 + (1 - a) c0. Halves are exact in binary.
  EXPECT_TRUE(near(middle(std::array{Pane{0, kGreen, 1}, Pane{1, kRed, 0.5}}), {0.5, 0.5, 0}, 1e-6));
  EXPECT_TRUE(near(middle(std::array{Pane{1, kRed, 0.5}, Pane{0, kGreen, 1}}), {0.5, 0.5, 0}, 1e-6));
  // The other way round: opaque green hides the red pane behind it.
  EXPECT_TRUE(near(middle(std::array{Pane{1, kGreen, 1}, Pane{0, kRed, 0.5}}), kGreen, 0));
  // Both half transparent, over blue: 1/2, 1/4, 1/4 from front to back.
  EXPECT_TRUE(
      near(middle(std::array{Pane{1, kRed, 0.5}, Pane{0, kGreen, 0.5}}, kBlue), {0.5, 0.25, 0.25}, 1e-6));
  EXPECT_TRUE(
      near(middle(std::array{Pane{0, kRed, 0.5}, Pane{1, kGreen, 0.5}}, kBlue), {0.25, 0.5, 0.25}, 1e-6));
  // The ends of the range.
  EXPECT_TRUE(near(middle(std::array{Pane{0, kGreen, 1}, Pane{1, kRed, 0}}), kGreen, 0));
}

TEST_F(Blending, OrderOfInsertionNeverMatters) {
  // Opaque and transparent, seen askew so that they overlap in part.
  std::vector<Pane> list{{0, {1, 0.2, 0.1}, 0.5},
                         {0.5, {0.1, 0.9, 0.3}, 0.25},
                         {1, {0.2, 0.3, 1}, 0.75},
                         {0.7, {0.9, 0.9, 0.1}, 1}};
  const Camera camera{.eye = Vec3(2, 1.5, 5), .lookAt = Vec3(0.5, 0.3, 0)};
  const Vec3 background(0.2, 0.1, 0.05);
  const auto smaller = [](const Pane& a, const Pane& b) { return a.z < b.z; };
  std::sort(list.begin(), list.end(), smaller);
  const Image expected = draw(panes(list, background), camera, kBlendingSize).image;
  int permutations = 1;
  while (std::next_permutation(list.begin(), list.end(), smaller)) {
    EXPECT_TRUE(sameBytes(draw(panes(list, background), camera, kBlendingSize).image, expected));
    ++permutations;
  }
  EXPECT_EQ(permutations, 24);
}

TEST_F(Blending, TransparentBallShowsItsBack) {
  // Its far wall, then its near one: two layers of one half over the background.
  const Vec3 color(0.8, 0.4, 0.2), background(0.1, 0.3, 0.9);
  for (const double mirror : {1.0, -1.0}) {
    Scene scene;
    scene.set(plainSettings(background));
    scene.add(
        Node{.scale = Vec3(mirror, 1, 1), .surface = sphere(1), .material = scene.add(glowing(color, 0.5))});
    const Camera camera{.eye = Vec3(0, 0, 5), .fovY = radians(40)};
    const CameraModel model(camera, kBlendingSize);
    const Image image = draw(scene, camera, kBlendingSize).image;
    const Vec3 expected = 0.5 * color + 0.5 * (0.5 * color + 0.5 * background);
    int inside = 0;
    for (int y = 0; y < kBlendingSize.height; ++y)
      for (int x = 0; x < kBlendingSize.width; ++x) {
        // The mesh is within half a pixel of the ball.
        const auto hit =
            settled([&](const Vec2& p) { return hitSphere(model.through(p), Vec3(0), 1).has_value(); },
                    centerOf(x, y), 0.5 + kSnapPx);
        if (!hit) continue;
        inside += *hit;
        ASSERT_TRUE(near(colorAt(image, x, y), *hit ? expected : background, 1e-6)) << x << ", " << y;
      }
    EXPECT_GT(inside, 500);
  }
}

TEST_F(Blending, OpaqueComesFirst) {
  // An opaque ball inside a transparent one, added last; a transparent pane in front of both; four layers of
  // glass.
  const Vec3 background(1, 1, 1);
  Scene scene;
  scene.set(plainSettings(background));
  const MaterialId glass = scene.add(glowing(kBlue, 0.5));
  scene.add(plate(Vec3(0, 0, 2), Vec2(4), glass));
  scene.add(Node{.surface = sphere(1), .material = glass});
  scene.add(Node{.surface = sphere(0.4), .material = scene.add(glowing(kRed))});
  const Camera camera{.eye = Vec3(0, 0, 5), .fovY = radians(40)};
  const Image image = draw(scene, camera, kBlendingSize).image;
  // Red, under the near wall and the pane; beside it white under three layers; farther out under one.
  EXPECT_TRUE(near(colorAt(image, kMiddle, kMiddle), {0.25, 0, 0.75}, 1e-6));
  const CameraModel model(camera, kBlendingSize);
  const Vec2 beside = model.pixelOf({0.7, 0, 0}), outside = model.pixelOf({1.3, 0, 0});
  EXPECT_TRUE(near(colorAt(image, static_cast<int>(beside.x), kMiddle), {0.125, 0.125, 1}, 1e-6));
  EXPECT_TRUE(near(colorAt(image, static_cast<int>(outside.x), kMiddle), {0.5, 0.5, 1}, 1e-6));
}

TEST_F(Blending, CrossingPanesBothShow) {
  // Each is in front of the other on one side.
  Scene scene;
  scene.set(plainSettings());
  for (const Vec3& color : {kRed, kGreen}) {
    Node pane = plate(Vec3(0), Vec2(2), scene.add(glowing(color, 0.5)));
    pane.parent = scene.add(Node{.rotation = Rotation{{0, 1, 0}, color == kRed ? 0.6 : -0.6}});
    scene.add(pane);
  }
  const Camera camera{.eye = Vec3(0, 0, 5), .fovY = radians(40)};
  const Image image = draw(scene, camera, kBlendingSize).image;
  // 13 pixels a metre in the middle, and 0.8 m to either side of it: these all show both. Turned to the right
  // about y the red one is nearer on the left.
  for (int y = 16; y < 32; ++y)
    for (int x = 16; x < 32; ++x)
      ASSERT_TRUE(near(colorAt(image, x, y), x < 24 ? Vec3(0.5, 0.25, 0) : Vec3(0.25, 0.5, 0), 1e-6))
          << x << ", " << y;
}

}  // namespace
}  // namespace luxo::test
