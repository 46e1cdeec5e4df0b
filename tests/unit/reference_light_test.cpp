// SPDX-License-Identifier: Apache-2.0
// Which part of a light the reference lets to a point, where that is known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "reference/caster.h"
#include "support/meshes.h"
#include "surface/library.h"
#include "unit/scene_test_support.h"

namespace luxo {
namespace {

constexpr PixelSize kLitSize{32, 32};

/// Of the first light at a point of the floor y = 0, from above.
template <class Found>
auto atFloor(const Snapshot& snapshot, const Vec3& point, const Found& found) {
  const reference::Caster caster(snapshot);
  const reference::Caster::Sight sight = caster.look({point + Vec3(0, 0.01, 0), Vec3(0, -1, 0)});
  EXPECT_EQ(sight.hits.size(), 1U);
  return found(caster, sight.hits.at(0));
}

Scene floorUnder(Surface caster, const Vec3& at, const Vec3& lightAt, Light light) {
  Scene scene;
  scene.add(Node{.name = "floor", .surface = rectangle(40, 40)});
  const NodeId body = scene.add(Node{.name = "body", .translation = at, .surface = std::move(caster)});
  light.casters = {body};
  scene.add(Node{.translation = lightAt, .light = std::move(light)});
  return scene;
}

Snapshot seenFromAbove(const Scene& scene) {
  return takeSnapshot(scene, 0, kLitSize,
                      Camera{.eye = Vec3(0, 9, 0), .lookAt = Vec3(0), .up = Vec3(0, 0, -1), .near = 1e-4});
}

struct LightOnBody {
  Surface body;
  Vec3 light;  // on it
  bool (*isLit)(const Vec3&);
};

/// What is before the tangent plane of a convex body sees a light on it; what is behind has the body between.
TEST(ReferenceLight, OnItsCasterIsBehindNoneOfIt) {
  const auto all = [](const Vec3&) { return true; };
  const double down = -0.6, aside = 0.8;
  const LightOnBody bodies[] = {
      {rectangle(2, 2), Vec3(0), all},
      {rectangle(2, 2), Vec3(0.3, 0, -0.7), all},
      {rectangle(2, 2), Vec3(1, 0, 1), all},
      {sphere(1), Vec3(0, -1, 0), all},
      {sphere(1), Vec3(0, 1, 0), [](const Vec3&) { return false; }},
      {sphere(1), Vec3(aside, down, 0), [](const Vec3& p) { return 0.8 * p.x - 0.6 * (p.y - 3) > 1; }},
      {torus(1, 0.25), Vec3(1, -0.25, 0), all},
      {torus(1, 0.25), Vec3(1.15, -0.2, 0), nullptr},
      {test::cubeMesh(), Vec3(0.3, -1, 0.2), all},
      {test::cubeMesh(), Vec3(1, -1, 0.2), all},
      {test::cubeMesh(), Vec3(1, -1, 1), all},
      {test::cubeMesh(), Vec3(0.25, -1, 0.25), all},
      {test::cubeMesh(), Vec3(0.3, 1, 0.2), [](const Vec3&) { return false; }},
  };
  for (std::size_t i = 0; i < std::size(bodies); ++i) {
    const LightOnBody& one = bodies[i];
    const Vec3 at(0, 3, 0);
    const Snapshot snapshot =
        seenFromAbove(floorUnder(one.body, at, at + one.light, {.shadow = Light::Shadow::Exact}));
    for (const double x : {-7.0, -1.3, -0.4, 0.1, 0.9, 2.3, 6.0})
      for (const double z : {-5.0, -0.7, 0.2, 1.1}) {
        SCOPED_TRACE(testing::Message() << i << ": " << x << ", " << z);
        bool certified = true;
        const Vec3 left = atFloor(snapshot, Vec3(x, 0, z), [&](const auto& caster, const auto& hit) {
          return caster.reaching(0, hit, certified);
        });
        EXPECT_TRUE(certified);
        if (one.isLit) {
          EXPECT_EQ(left, Vec3(one.isLit(Vec3(x, 0, z)) ? 1 : 0));
        }
      }
  }
}

/// As near as roots are known it is on the caster; farther it is before or behind it.
TEST(ReferenceLight, BesideItsCasterIsOnASide) {
  for (const double above : {-1e-6, 1e-6}) {
    const Snapshot snapshot = seenFromAbove(
        floorUnder(rectangle(2, 2), Vec3(0, 3, 0), Vec3(0, 3 + above, 0), {.shadow = Light::Shadow::Exact}));
    bool certified = true;
    const Vec3 left = atFloor(snapshot, Vec3(1, 0, 2), [&](const auto& caster, const auto& hit) {
      return caster.reaching(0, hit, certified);
    });
    EXPECT_EQ(left, Vec3(above < 0 ? 1 : 0));
    EXPECT_TRUE(certified);
  }
}

/// Of a disc beyond a chord at x of its radius.
double partBeyond(double x) {
  x = std::clamp(x, -1.0, 1.0);
  return 0.5 - (std::asin(x) + x * std::sqrt(1 - x * x)) / kPi;
}

/// Below the edge of a half plane a light's disc is cut by a chord, and above a floor by its horizon.
TEST(ReferenceLight, APartOfADiscIsSeen) {
  constexpr double kRadius = 0.2;
  Light lamp{.shadow = Light::Shadow::Map, .radius = kRadius};
  const Snapshot snapshot =
      withExactShadows(seenFromAbove(floorUnder(rectangle(10, 10), Vec3(-5, 2, 0), Vec3(0, 4, 0), lamp)));
  ASSERT_EQ(snapshot.lights.size(), 16U);
  const std::vector<WholeLight> wholes = wholeLights(snapshot);
  ASSERT_EQ(wholes.size(), 1U);
  EXPECT_FALSE(wholes[0].number);
  EXPECT_EQ(wholes[0].radius, kRadius);
  EXPECT_EQ(wholes[0].light.positionWorld, Vec4(0, 4, 0, 1));
  EXPECT_NEAR(wholes[0].light.radiance.x, 1, 1e-12);
  for (double x = -0.4; x <= 0.4; x += 0.01) {
    const auto part = atFloor(snapshot, Vec3(x, 0, 0.3), [&](const auto& caster, const auto& hit) {
      return caster.seenPart(caster.wholes()[0], hit);
    });
    // The edge x = 0 at half the height is seen at -x of the light; this is seen slightly from aside.
    const double truth = partBeyond(-x / kRadius);
    EXPECT_LE(part.least.x, truth + 2e-3) << x;
    EXPECT_GE(part.most.x, truth - 2e-3) << x;
    EXPECT_LE(part.most.x - part.least.x, 2 * reference::kSeenPartOff + 1e-12);
  }
}

}  // namespace
}  // namespace luxo
