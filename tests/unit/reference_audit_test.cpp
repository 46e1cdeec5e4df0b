// SPDX-License-Identifier: Apache-2.0
// What an audit says of depths that are right, of another layer, off by a little, or beside an outline; and
// of colours.
#include "reference/audit.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "scene/pattern.h"
#include "scene/scene.h"
#include "scene/snapshot.h"
#include "surface/library.h"

namespace luxo::reference {
namespace {

constexpr std::array<std::uint32_t, 1> kNodes{0};
constexpr double kNothing = std::numeric_limits<double>::infinity(), kRounding = 1e-7;

/// A picture of 100 x 100 pixels, 100 of them a metre wide at the origin, 10 m away: parallel rays along -z.
Snapshot pictureOf(const Surface& surface, const Rotation& rotation = {}) {
  Scene scene;
  scene.add(Node{.rotation = rotation, .surface = surface});
  scene.add(Camera{.eye = Vec3(0, 0, 10), .projection = Projection::Orthographic, .height = 1});
  return takeSnapshot(scene, 0, {100, 100});
}

TEST(Audit, TellsLayersAndMisses) {
  const Snapshot snapshot = pictureOf(sphere(0.4));
  const Caster caster(snapshot);
  const auto judged = [&](const Vec2& pixel, double depth) {
    return judge(caster, kNodes, pixel, depth, kRounding);
  };
  const Vec2 inside(60.5, 50.5), outside(95.5, 50.5);
  const double x = 0.105, y = -0.005, z = std::sqrt(0.16 - x * x - y * y);
  EXPECT_EQ(judged(inside, 10 - z), Judgement::Right);
  EXPECT_EQ(judged(inside, 10 + z), Judgement::Wrong) << "the far side";
  EXPECT_EQ(judged(inside, kNothing), Judgement::Wrong);
  EXPECT_EQ(judged(outside, kNothing), Judgement::Right);
  EXPECT_EQ(judged(outside, 10), Judgement::Wrong) << "nothing is there";
}

// The sphere's outline is 40 pixels from the middle.
TEST(Audit, NextToAnOutlineEitherSideIsRight) {
  const Snapshot snapshot = pictureOf(sphere(0.4));
  const Caster caster(snapshot);
  const auto judged = [&](double right, double depth) {
    return judge(caster, kNodes, Vec2(50 + right, 50), depth, kRounding);
  };
  EXPECT_EQ(judged(40 - 0.005, kNothing), Judgement::Right);
  EXPECT_EQ(judged(40 - 0.02, kNothing), Judgement::Wrong);
  const double justInside = 10 - std::sqrt(0.16 - 0.39997 * 0.39997);
  EXPECT_EQ(judged(40 + 0.005, justInside), Judgement::Right);
  EXPECT_EQ(judged(40 + 0.02, justInside), Judgement::Wrong);
}

// Of a plane at 60 degrees a hundredth of a pixel across is as much as tan 60 of it in depth.
TEST(Audit, APointMayBeAThousandthOfAPixelOff) {
  const Snapshot snapshot = pictureOf(rectangle(0.8, 0.8), {{1, 0, 0}, kPi / 2 - kPi / 3});
  const Caster caster(snapshot);
  const Vec2 pixel(50.5, 60.5);
  const auto first = caster.firstOf(kNodes, caster.rayThrough(pixel.x, pixel.y));
  ASSERT_TRUE(first.hit);
  const double depth = 10 - first.hit->position.z, perPixel = 0.01 * std::tan(kPi / 3);
  EXPECT_EQ(judge(caster, kNodes, pixel, depth + 0.5e-3 * perPixel, kRounding), Judgement::Right);
  // The plane that a depth may be off along is a little steeper, as it is so from all sides: by 1 / sin 60.
  EXPECT_EQ(judge(caster, kNodes, pixel, depth + 1.3e-3 * perPixel, kRounding), Judgement::Wrong);
  EXPECT_EQ(judge(caster, kNodes, pixel, depth + 5e-3 * perPixel, kRounding), Judgement::Wrong);
  EXPECT_EQ(judge(caster, kNodes, pixel, depth + 5e-3 * perPixel, 1e-3), Judgement::Right) << "rounding";
}

/// A floor that fills the picture, in it the shadow of a ball around pixel (30, 50), left of the ball itself.
Snapshot shadowOfBall(bool withBall, const Material& floor = {.diffuse = Vec3(0.8)}) {
  Scene scene;
  scene.set(RenderSettings{.ambient = Vec3(0.1)});
  const MaterialId material = scene.add(floor);
  scene.add(Node{.rotation = Rotation{{1, 0, 0}, kPi / 2}, .surface = rectangle(2, 2), .material = material});
  if (withBall) scene.add(Node{.translation = Vec3(0, 0, 0.3), .surface = sphere(0.1)});
  scene.add(Node{.translation = Vec3(0.6, 0, 1.2), .light = Light{.shadow = Light::Shadow::Exact}});
  scene.add(Camera{.eye = Vec3(0, 0, 10), .projection = Projection::Orthographic, .height = 1});
  return takeSnapshot(scene, 0, {100, 100});
}

Vec3 colorIn(const Caster& caster, const Vec2& pixel) {
  const Ray ray = caster.rayThrough(pixel.x, pixel.y);
  bool certified = true;
  const Vec3 color = caster.color(ray, caster.look(ray), certified);
  EXPECT_TRUE(certified);
  return color;
}

TEST(Audit, SeesLightThatIsNotThereAndShadowsThatAreNot) {
  const Snapshot snapshot = shadowOfBall(true), bare = shadowOfBall(false);
  const Caster caster(snapshot), unshadowed(bare);
  const Vec2 inShadow(30.5, 50.5), lit(85.5, 50.5);
  const Vec3 light = colorIn(caster, lit), dark = colorIn(caster, inShadow);
  const auto judged = [&](const Vec2& pixel, const Vec3& shown) {
    return judgeColor(caster, pixel, shown, kRounding);
  };
  ASSERT_GT(light.x, 2 * dark.x);
  EXPECT_EQ(judged(lit, light), Judgement::Right);
  EXPECT_EQ(judged(inShadow, dark), Judgement::Right);
  EXPECT_EQ(judged(inShadow, colorIn(unshadowed, inShadow)), Judgement::Wrong);
  EXPECT_EQ(judged(lit, dark), Judgement::Wrong);
  // What 8 bits show counts, in any channel.
  EXPECT_EQ(judged(lit, light + Vec3(0, 0, 0.5 / 255)), Judgement::Right);
  EXPECT_EQ(judged(lit, light + Vec3(0, 0, 1.5 / 255)), Judgement::Wrong);
}

TEST(Audit, BesideAShadowsBorderEitherColorIsRight) {
  const Snapshot snapshot = shadowOfBall(true), bare = shadowOfBall(false);
  const Caster caster(snapshot), unshadowed(bare);
  const auto isLit = [&](double x) {
    return colorIn(caster, {x, 50}).x > 0.5 * colorIn(unshadowed, {x, 50}).x;
  };
  double dark = 30, light = 10;
  ASSERT_TRUE(isLit(light) && !isLit(dark));
  while (dark - light > 1e-9) (isLit(0.5 * (dark + light)) ? light : dark) = 0.5 * (dark + light);
  const auto judgedAsLit = [&](double x) {
    return judgeColor(caster, {x, 50}, colorIn(unshadowed, {x, 50}), kRounding);
  };
  EXPECT_EQ(judgedAsLit(dark + 0.005), Judgement::Right);
  EXPECT_EQ(judgedAsLit(dark + 0.02), Judgement::Wrong);
}

// Which of two sheets in one place is seen nobody can tell; a little apart it is the nearer one.
TEST(Audit, OfWhatTouchesEitherColorIsRight) {
  for (const double apart : {0.0, 1e-3}) {
    Scene scene;
    scene.set(RenderSettings{.ambient = Vec3(1)});
    for (const Vec3& color : {Vec3(0.8, 0.2, 0.2), Vec3(0.2, 0.2, 0.8)})
      scene.add(Node{.translation = Vec3(0, 0, color.x < 0.5 ? apart : 0),
                     .rotation = Rotation{{1, 0, 0}, kPi / 2},
                     .surface = rectangle(2, 2),
                     .material = scene.add(Material{.diffuse = color})});
    scene.add(Camera{.eye = Vec3(0, 0, 10), .projection = Projection::Orthographic, .height = 1});
    const Snapshot snapshot = takeSnapshot(scene, 0, {100, 100});
    const Caster caster(snapshot);
    EXPECT_EQ(judgeColor(caster, {50.5, 50.5}, Vec3(0.2, 0.2, 0.8), kRounding), Judgement::Right);
    EXPECT_EQ(judgeColor(caster, {50.5, 50.5}, Vec3(0.8, 0.2, 0.2), kRounding),
              apart == 0 ? Judgement::Right : Judgement::Wrong);
  }
}

TEST(Audit, OfWhatIsFlattenedEitherSideIsRight) {
  for (const double thickness : {0.0, 1.0}) {
    Scene scene;
    scene.add(
        Node{.rotation = Rotation{{0, 1, 0}, 0.3}, .scale = Vec3(1, 1, thickness), .surface = sphere(0.4)});
    scene.add(Node{.translation = Vec3(0, 0, 5), .light = Light{}});
    scene.add(Camera{.eye = Vec3(0, 0, 10), .projection = Projection::Orthographic, .height = 1});
    const Snapshot snapshot = takeSnapshot(scene, 0, {100, 100});
    const Caster caster(snapshot);
    EXPECT_EQ(judgeColor(caster, {50.5, 50.5}, Vec3(0), kRounding),
              thickness == 0 ? Judgement::Right : Judgement::Wrong);
  }
}

TEST(Audit, KnowsNoColorsThatRoundingMoves) {
  const Vec2 pixel(85.5, 50.5);
  const Material patterned{.diffusePattern = pattern([](auto u, auto v) { return point(u, v, u); })},
      glossy{.diffuse = Vec3(0.8), .shininess = 1e5};
  for (const Material& material : {patterned, glossy}) {
    const Snapshot snapshot = shadowOfBall(true, material);
    EXPECT_EQ(judgeColor(Caster(snapshot), pixel, Vec3(7), kRounding), Judgement::Right);
  }
}

}  // namespace
}  // namespace luxo::reference
