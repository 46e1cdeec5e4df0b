// SPDX-License-Identifier: Apache-2.0
// A light is left out only where it lights no point at all.
#include "cull/reach.h"

#include <algorithm>
#include <cmath>

#include "cull/cull.h"
#include "luxo_grandpa/lamp.h"
#include "scene_test_support.h"

namespace luxo {
namespace {

/// Surfaces at random places, of which most that no light reaches are known to be such, and no other is.
class RandomPlaces {
 public:
  /// Two functions: whether a light may reach a box that is placed so, and whether it does a point. One in
  /// four boxes has its middle on the axis, `onAxis` of how far from the light, as what a light is aimed at.
  void hold(test::Random& random, const Rotation& tilt, const auto& onAxis, const auto& mayReach,
            const auto& reaches) {
    const Surface surface = random.surface();
    Transform place = compose(random.inCube(4), rotation(tilt.axis, tilt.angle), random.scale());
    if (++placed_ % 4 == 0)
      place.translation +=
          Vec3(onAxis(random.uniform(-3, 3))) - transformPoint(place, surface.bounds({}).center());
    const bool reached = mayReach(place, surface.bounds({}));
    const std::vector<Vec3> points = test::sample(surface, 20);
    const bool anyLit =
        std::ranges::any_of(points, [&](const Vec3& p) { return reaches(transformPoint(place, p)); });
    ASSERT_TRUE(reached || !anyLit);
    dark_ += !anyLit;
    found_ += !reached;
  }
  void finish() const {
    EXPECT_GT(dark_, 1000);
    EXPECT_GT(found_, dark_ * 8 / 10);
    testing::Test::RecordProperty("found_percent", 100 * found_ / dark_);
  }

 private:
  int placed_ = 0, dark_ = 0, found_ = 0;
};

TEST(Reach, NoNodeWithALitPointIsOutOfReach) {
  test::Random random(31);
  RandomPlaces places;
  for (const auto& [f, h] : {std::pair(0.2, 1.8), {0.5, 0.5}, {1.0, 0.3}, {0.05, 2.0}}) {
    for (int i = 0; i < 1500; ++i) {
      const Rotation turn = random.rotation(), tilt = random.rotation();
      const auto rule = shadeRule(
          {f, h}, compose(random.inCube(1), rotation(turn.axis, turn.angle), Vec3(random.uniform(0.3, 2))),
          {});
      ASSERT_TRUE(rule);
      ASSERT_NO_FATAL_FAILURE(places.hold(
          random, tilt, [&](double far) { return rule->focus + far * rule->axis; },
          [&](const Transform& place, const Box& box) { return canLight(*rule, place, box, 0); },
          [&](const Vec3& p) { return lit(*rule, p); }));
    }
  }
  places.finish();
}

// Behind the focus, along the axis, but not behind the shade.
TEST(Reach, BetweenAShallowRimAndItsFocusAllIsLit) {
  const auto rule = shadeRule({1.0, 0.3}, Transform{}, {});
  const Box between{Vec3(-0.1, 0.5, -0.1), Vec3(0.1, 0.7, 0.1)};
  ASSERT_TRUE(lit(*rule, between.center()));
  EXPECT_TRUE(canLight(*rule, Transform{}, between, 0));
}

TEST(Reach, SlackWidensTheLight) {
  const auto rule = shadeRule({0.2, 1.8}, Transform{}, {});
  const Box below{Vec3(-1, -2, -1), Vec3(1, -0.5, 1)};  // half a metre behind the vertex
  EXPECT_FALSE(canLight(*rule, Transform{}, below, 0));
  EXPECT_FALSE(canLight(*rule, Transform{}, below, 0.3));
  EXPECT_TRUE(canLight(*rule, Transform{}, below, 1));
}

TEST(Reach, NoNodeWithAPointInASpotsConeIsOutOfReach) {
  test::Random random(32);
  RandomPlaces places;
  for (const double outer : {0.1, 0.5, 1.2, kPi / 2})
    for (int i = 0; i < 1500; ++i) {
      const SpotCone cone{.axis = random.direction(), .inner = 0.5 * outer, .outer = outer};
      const Vec3 at = random.inCube(3);
      const Rotation tilt = random.rotation();
      ASSERT_NO_FATAL_FAILURE(places.hold(
          random, tilt, [&](double far) { return at + far * cone.axis; },
          [&](const Transform& place, const Box& box) { return canLight(cone, at, place, box, 0); },
          [&](const Vec3& p) { return spotAttenuation(cone, p - at) > 0; }));
    }
  places.finish();
  const SpotCone down{.axis = {0, -1, 0}, .inner = 0.1, .outer = kPi / 4};
  const Box aside{Vec3(2, -1, -0.1), Vec3(3, 0, 0.1)};  // half a root of 2 from the cone at (0, 0, 0)
  EXPECT_FALSE(canLight(down, Vec3(0), Transform{}, aside, 0));
  EXPECT_FALSE(canLight(down, Vec3(0), Transform{}, aside, 0.7));
  EXPECT_TRUE(canLight(down, Vec3(0), Transform{}, aside, 0.71));
}

TEST(Reach, LightsOfTheLampAreCounted) {
  const Scene scene = luxoGrandpa();
  const auto lightsOf = [&](double time, const char* name, const CullOptions& options = {}) {
    const Snapshot snapshot = takeSnapshot(scene, time, {1280, 720});
    const VisibleList list = cull(snapshot, options);
    for (const VisibleNode& node : list.opaque)
      if (scene[snapshot.nodes[node.node].id].name == name)
        return std::vector(list.lights.begin() + node.firstLight,
                           list.lights.begin() + node.firstLight + node.lightCount);
    throw std::runtime_error(std::string(name) + " is not visible");
  };
  const std::vector<std::uint32_t> room = {0}, both = {0, 1};
  // At t = 0 the lamp points straight up: nothing but the shade itself sees its light.
  for (const char* name : {"floor", "base", "base top", "joint 1", "rod 1", "joint 2", "rod 2"})
    EXPECT_EQ(lightsOf(0, name), room) << name;
  EXPECT_EQ(lightsOf(0, "shade"), both);
  // At t = 21 it points down at the floor.
  EXPECT_EQ(lightsOf(21, "floor"), both);
  EXPECT_EQ(lightsOf(0, "floor", {.lights = false}), both);

  const Snapshot snapshot = takeSnapshot(scene, 0, {1280, 720});
  EXPECT_GE(cull(snapshot).counts.culledLights, 7u);
  EXPECT_EQ(cull(snapshot, {.lights = false}).counts.culledLights, 0u);
}

TEST(Reach, OnlyBlackAndShadedLightsAreLeftOut) {
  Scene scene;
  scene.add(Node{.surface = sphere(1)});
  scene.add(Node{.translation = Vec3(1e6, 0, 0), .light = Light{.intensity = 1e-9}});
  scene.add(Node{.light = Light{.type = Light::Type::Directional}});
  scene.add(Node{.light = Light{.intensity = 0}});
  const VisibleList list = cull(takeSnapshot(scene, 0, {100, 100}));
  EXPECT_EQ(list.lights.size(), 2u);
  EXPECT_EQ(list.counts.culledLights, 1u);
}

}  // namespace
}  // namespace luxo
