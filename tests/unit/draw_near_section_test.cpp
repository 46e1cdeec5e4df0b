// SPDX-License-Identifier: Apache-2.0
// Cameras are put so that their near plane cuts a shell at a known place: its pixel has to be told.
#include "draw/near_section.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "scene/camera.h"
#include "shell/shell.h"
#include "surface/catalogue.h"

namespace luxo {
namespace {

class NearSection : public testing::TestWithParam<Projection> {};

INSTANTIATE_TEST_SUITE_P(Of, NearSection, testing::Values(Projection::Perspective, Projection::Orthographic),
                         [](const auto& p) {
                           return p.param == Projection::Perspective ? "Perspective" : "Orthographic";
                         });

TEST_P(NearSection, HoldsEveryPixelWhoseRayBeginsInThePrisms) {
  const Surface surface = makeSurface("klein");
  const Shell shell = *makeShell(surface, {}, CurvatureMap(surface, {}), {.tolerance = 0.02});
  const SnapshotNode node{.worldFromObject = {}, .surface = surface};
  std::mt19937 engine(7);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  };
  const auto direction = [&] { return glm::normalize(Vec3(between(-1, 1), between(-1, 1), between(-1, 1))); };
  for (int k = 0; k < 300; ++k) {
    // A place in a prism.
    const auto& part = shell.parts[static_cast<std::size_t>(k) % shell.parts.size()];
    const std::uint32_t triangle = 3 * static_cast<std::uint32_t>(between(0, part.faceCount() / 3.0 - 1e-9));
    const auto in = [&](std::uint32_t face, double b, double c) {
      const auto corner = [&](std::uint32_t i) {
        return shell.positions[shell.indices[face + triangle + i]];
      };
      return (1 - b - c) * corner(0) + b * corner(1) + c * corner(2);
    };
    const double b = between(0, 1), c = between(0, 1 - b), s = between(0, 1);
    // Bottoms turn the other way: their second corner stands under the third of the top.
    const Vec3 place = s * in(part.firstIndex, b, c) + (1 - s) * in(part.bottomIndex(), c, b);

    const Vec3 forward = direction();
    Camera camera{.eye = Vec3(0), .lookAt = forward, .up = direction()};
    camera.near = between(0.001, 0.5);
    camera.fovY = between(0.2, 2.9);
    camera.height = between(0.1, 3);
    camera.projection = GetParam();
    const Box all{Vec3(-100), Vec3(100)};  // around the eye: parallel rays begin on the near plane
    const View before = viewAt(camera, {}, {64, 48}, all);
    const Vec2 pixel(between(0, 64), between(0, 48));
    const Vec2 across = Vec2(2 * pixel.x / 64 - 1, 1 - 2 * pixel.y / 48) * before.halfExtent;
    const Vec3 aside = across.x * before.right() + across.y * before.up();
    const Vec3 eye =
        place - before.near * before.forward() - (before.perspective() ? before.near : 1.0) * aside;
    camera.eye = eye;
    camera.lookAt = eye + forward;
    const View view = viewAt(camera, {}, {64, 48}, all);
    ASSERT_EQ(view.near, before.near);

    std::vector<PixelRect> rects;
    appendNearSection(view, node, shell, part, rects);
    EXPECT_TRUE(std::ranges::any_of(rects, [&](const PixelRect& r) {
      return pixel.x >= r.low.x && pixel.x <= r.high.x && pixel.y >= r.low.y && pixel.y <= r.high.y;
    })) << k;
  }
}

// Far from everything it cuts nothing.
TEST(NearSection, IsEmptyWhereNothingIsNear) {
  const Surface surface = makeSurface("klein");
  const Shell shell = *makeShell(surface, {}, CurvatureMap(surface, {}), {.tolerance = 0.02});
  const SnapshotNode node{.worldFromObject = {}, .surface = surface};
  const View view = viewAt({.eye = Vec3(0, 0, 100)}, {}, {64, 48});
  std::vector<PixelRect> rects;
  for (const Shell::Part& part : shell.parts) appendNearSection(view, node, shell, part, rects);
  EXPECT_TRUE(rects.empty());
}

}  // namespace
}  // namespace luxo
