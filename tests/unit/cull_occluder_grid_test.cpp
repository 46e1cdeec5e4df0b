// SPDX-License-Identifier: Apache-2.0
// What balls hide: every ray to it, through a pixel or half a pixel beside, meets the middle section of one
// before.
#include "cull/occluder_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "scene/view.h"
#include "scene_test_support.h"

namespace luxo {
namespace {

constexpr PixelSize kGridView{200, 150};
constexpr double kSlack = 1e-4;

Camera cameraAnywhere(test::Random& random) {
  return {.eye = 5.0 * random.direction(),
          .lookAt = random.inCube(0.5),
          .fovY = radians(random.uniform(10, 100)),
          .near = random.uniform(0.01, 3),
          .projection = random.below(3) ? Projection::Perspective : Projection::Orthographic,
          .height = random.uniform(1, 6)};
}

/// Whether what is seen in a pixel as deep as a point is behind the ball's middle section.
bool isBehind(const View& view, const Sphere& ball, const Vec3& pointEye, const Vec2& besidePx) {
  const Vec3 center = eyeFromWorldPoint(view, ball.center);
  if (!(pointEye.z < center.z) || !(center.z < -view.near)) return false;
  const Vec2 way = pixelFromEye(view, pointEye) + besidePx - pixelFromEye(view, center);
  const double metresPerPixel = (view.perspective() ? -center.z : 1) / view.pixelsPerUnit;
  return glm::length(way) * metresPerPixel < ball.radius - kSlack;
}

TEST(OccluderGrid, HidesOnlyWhatIsBehindABallInEveryPixel) {
  test::Random random(8);
  int hidden = 0;
  for (int i = 0; i < 400; ++i) {
    const View view = viewAt(cameraAnywhere(random), {}, kGridView, Box{Vec3(-3), Vec3(3)});
    OccluderGrid grid(view);
    EXPECT_TRUE(grid.empty());
    std::vector<Sphere> balls;
    for (int k = 0; k < 6; ++k) {
      balls.push_back({random.inCube(2), random.uniform(0.05, 1.2)});
      grid.cover(balls.back(), kSlack);
    }
    for (int k = 0; k < 100; ++k) {
      const Sphere thing{random.inCube(4), random.uniform(0, 0.3)};
      if (!grid.hides(thing)) continue;
      ++hidden;
      for (int n = 0; n < 50; ++n) {
        const Vec3 point = eyeFromWorldPoint(view, thing.center + thing.radius * random.direction());
        ASSERT_LT(point.z, -view.near);
        const Vec2 pixel = pixelFromEye(view, point);
        const bool isSeen =
            pixel.x > 0 && pixel.y > 0 && pixel.x < kGridView.width && pixel.y < kGridView.height;
        const Vec2 beside(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5));
        ASSERT_TRUE(!isSeen || std::ranges::any_of(balls, [&](const Sphere& ball) {
          return isBehind(view, ball, point, beside);
        })) << i;
      }
    }
  }
  EXPECT_GT(hidden, 3000);
}

TEST(OccluderGrid, HidesMostOfWhatIsBehindOne) {
  const View view = viewAt({.eye = Vec3(0, 0, 10), .lookAt = Vec3(0), .fovY = radians(45)}, {}, kGridView);
  OccluderGrid grid(view);
  grid.cover({Vec3(0), 1}, kSlack);
  EXPECT_TRUE(grid.hides({Vec3(0, 0, -2), 0.8}));
  EXPECT_TRUE(grid.hides({Vec3(0.5, 0.3, -2), 0.3}));
  EXPECT_FALSE(grid.hides({Vec3(0, 0, -2), 1.3})) << "wider";
  EXPECT_FALSE(grid.hides({Vec3(0, 0, 2), 0.1})) << "before";
  EXPECT_FALSE(grid.hides({Vec3(0, 0, 0), 0.1})) << "in it";
}

}  // namespace
}  // namespace luxo
