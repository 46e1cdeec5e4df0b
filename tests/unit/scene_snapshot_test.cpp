// SPDX-License-Identifier: Apache-2.0
// What changed between two moments, and what leaves no trace.
#include "scene/snapshot.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "image/texture.h"
#include "scene_test_support.h"

namespace luxo {
namespace {

using test::expectNear;
using test::expectSceneError;
using test::snap;

Scene plain() {
  Scene scene;
  scene.add(Node{.name = "floor", .surface = rectangle(4, 4)});
  scene.add(Node{.name = "ball", .translation = Vec3(0, 1, 0), .surface = sphere(1)});
  scene.add(Node{.name = "sun", .light = Light{.type = Light::Type::Directional}});
  scene.add(Camera{});
  return scene;
}

TEST(Snapshot, StillScenesAreTheSameAtAllTimes) {
  const Scene scene = plain();
  EXPECT_FALSE(scene.movesWithTime());
  EXPECT_TRUE(snap(scene, 0) == snap(scene, 1e6));
}

TEST(Snapshot, AnyFunctionOfTimeMovesTheScene) {
  const auto moves = [](auto change) {
    Scene scene = plain();
    change(scene);
    return scene.movesWithTime();
  };
  EXPECT_FALSE(moves([](Scene&) {}));
  EXPECT_TRUE(moves([](Scene& s) { s.add(Node{.translation = [](double t) { return Vec3(t); }}); }));
  EXPECT_TRUE(moves([](Scene& s) { s.add(Node{.rotation = spin({0, 1, 0}, 1)}); }));
  EXPECT_TRUE(moves([](Scene& s) { s.add(Node{.scale = [](double t) { return Vec3(1 + t); }}); }));
  EXPECT_TRUE(moves([](Scene& s) { s.add(Node{.visible = [](double t) { return t > 1; }}); }));
  EXPECT_TRUE(moves([](Scene& s) { s.add(Node{.surface = flag({.phase = [](double t) { return t; }})}); }));
  EXPECT_TRUE(moves([](Scene& s) { s.add(Node{.light = Light{.intensity = [](double t) { return t; }}}); }));
  EXPECT_TRUE(
      moves([](Scene& s) { s.add(Animated<Material>([](double t) { return Material{.shininess = t}; })); }));
  EXPECT_TRUE(moves([](Scene& s) { s.add(Camera{.fovY = [](double t) { return t; }}); }));
  EXPECT_TRUE(moves([](Scene& s) { s.add(Camera{.eye = [](double t) { return Vec3(t, 0, 5); }}); }));
  EXPECT_FALSE(moves([](Scene& s) { s.remove(s.add(Node{.rotation = spin({0, 1, 0}, 1)})); }));
}

TEST(Snapshot, MomentsDifferInWhatMoves) {
  Scene scene = plain();
  scene.add(Node{.name = "flag", .surface = flag({.phase = [](double t) { return t; }})});
  scene.add(Node{.name = "top", .rotation = spin({1, 2, 3}, 1), .surface = cone(1, 0, 1)});
  const Snapshot before = snap(scene, 1);
  Snapshot after = snap(scene, 2);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(before.nodes[i] == after.nodes[i], i < 2) << i;
  EXPECT_FALSE(before == after);
  after.nodes = before.nodes;
  EXPECT_TRUE(before == after);
}

TEST(Snapshot, EditsAreFoundOneByOne) {
  const Scene scene = plain();
  const Snapshot before = snap(scene);
  /// Whether an edit changes nothing but what `member` says, which is one of a snapshot's.
  const auto changes = [&](auto member, auto edit) {
    Scene edited = scene;
    edit(edited);
    Snapshot after = snap(edited);
    if (before == after) return false;
    after.*member = before.*member;
    return before == after;
  };
  EXPECT_TRUE(
      changes(&Snapshot::materials, [](Scene& s) { s.set(MaterialId{0}, Material{.shininess = 5}); }));
  EXPECT_TRUE(changes(&Snapshot::ambient, [](Scene& s) { s.set(RenderSettings{.ambient = Vec3(0.3)}); }));
  EXPECT_TRUE(
      changes(&Snapshot::background, [](Scene& s) { s.set(RenderSettings{.background = Vec3(0.3)}); }));
  EXPECT_TRUE(changes(&Snapshot::view, [](Scene& s) { s.set(CameraId{0}, Camera{.near = 0.2}); }));
  EXPECT_TRUE(
      changes(&Snapshot::lights, [](Scene& s) { s.set(NodeId{2}, Node{.light = Light{.intensity = 2}}); }));
  EXPECT_TRUE(changes(&Snapshot::nodes, [](Scene& s) { s.remove(NodeId{1}); }));
  EXPECT_TRUE(changes(&Snapshot::nodes, [](Scene& s) { s.add(Node{.surface = sphere(1)}); }));
  EXPECT_TRUE(changes(&Snapshot::nodes, [](Scene& s) { s.set(NodeId{0}, Node{.surface = rectangle(4, 5)}); }))
      << "another surface";
  Scene more = scene;
  more.add(Node{.name = "nothing to see"});
  EXPECT_TRUE(before == snap(more));
  Snapshot bigger = takeSnapshot(scene, 0, {200, 100});
  EXPECT_FALSE(before == bigger);
  bigger.view = before.view;
  EXPECT_TRUE(before == bigger);
}

TEST(Snapshot, LightsComeInAnOrderThatDoesNotDependOnTheScenes) {
  const std::vector<Node> nodes = {
      Node{.translation = Vec3(1, 2, 3), .light = Light{.intensity = 3}},
      Node{.translation = Vec3(1, 2, 4), .light = Light{.intensity = 3}},
      Node{.translation = Vec3(5, 0, 0), .light = Light{.color = Vec3(1, 0.5, 0.2)}},
      Node{.light = Light{.type = Light::Type::Directional}},
  };
  const auto lightsOf = [&](const std::vector<int>& order) {
    Scene scene;
    for (const int i : order) scene.add(nodes[i]);
    std::vector<std::pair<Vec4, Vec3>> found;
    for (const SnapshotLight& light : snap(scene).lights)
      found.emplace_back(light.positionWorld, light.radiance);
    return found;
  };
  std::vector<int> order = {0, 1, 2, 3};
  const auto expected = lightsOf(order);
  while (std::next_permutation(order.begin(), order.end())) EXPECT_EQ(lightsOf(order), expected);
}

/// A light with a radius is as many lights, which share its light evenly and are all within the radius.
TEST(Snapshot, ALightWithARadiusIsManyLights) {
  using S = Light::Shadow;
  const auto lightsOf = [](Light light, std::uint32_t most = kMaxShadowSamples) {
    Scene scene;
    scene.add(Node{.surface = sphere(1)});
    scene.add(Node{.translation = Vec3(3, 4, 5), .light = std::move(light)});
    return takeSnapshot(scene, 2, {64, 64}, CameraId{}, most).lights;
  };
  const auto total = [](const std::vector<SnapshotLight>& lights) {
    Vec3 sum(0);
    for (const SnapshotLight& light : lights) sum += light.radiance;
    return sum;
  };
  const Light point{.intensity = 8, .shadow = S::Exact, .radius = [](double t) { return 0.25 * t; }};
  const std::vector<SnapshotLight> ball = lightsOf(point);
  ASSERT_EQ(ball.size(), 16u);
  expectNear(total(ball), Vec3(8), 1e-12);
  double farthest = 0;
  for (const SnapshotLight& light : ball) {
    EXPECT_EQ(light.casters.size(), 1u);
    farthest = std::max(farthest, glm::distance(Vec3(light.positionWorld), Vec3(3, 4, 5)));
  }
  EXPECT_LE(farthest, 0.5);
  EXPECT_GT(farthest, 0.4);

  Light sun{.type = Light::Type::Directional, .shadow = S::Exact, .radius = 0.1, .shadowSamples = 50};
  const std::vector<SnapshotLight> disc = lightsOf(sun);
  ASSERT_EQ(disc.size(), 50u);
  for (const SnapshotLight& light : disc) {
    EXPECT_NEAR(glm::length(Vec3(light.positionWorld)), 1, 1e-15);
    EXPECT_GE(light.positionWorld.z, std::cos(0.1) - 1e-15);  // toward the light is +Z
  }
  EXPECT_EQ(lightsOf(sun, 4).size(), 4u);
  const std::vector<SnapshotLight> one = lightsOf(sun, 1);
  ASSERT_EQ(one.size(), 1u);
  expectNear(Vec3(one[0].positionWorld), Vec3(0, 0, 1), 1e-15);

  // Without a radius or a shadow it is one light; the largest radius is as good as any.
  sun.radius = 0.0;
  EXPECT_EQ(lightsOf(sun).size(), 1u);
  sun.radius = 0.1;
  sun.shadow = S::None;
  EXPECT_EQ(lightsOf(sun).size(), 1u);
  Light huge{.shadow = S::Exact, .radius = 1e9, .shadowSamples = 1024};
  const std::vector<SnapshotLight> many = lightsOf(huge);
  ASSERT_EQ(many.size(), 1024u);
  for (const SnapshotLight& light : many) EXPECT_LE(glm::length(Vec3(light.positionWorld)), 1.0001e9);
}

TEST(Snapshot, RadiiOutOfRangeAreErrors) {
  const auto snapped = [](const Light::Type type, double radius) {
    Scene scene;
    scene.add(Node{.surface = sphere(1)});
    scene.add(Node{.name = "sun",
                   .light = Light{.type = type, .shadow = Light::Shadow::Exact, .radius = [=](double) {
                                    return radius;
                                  }}});
    static_cast<void>(snap(scene));
  };
  using T = Light::Type;
  EXPECT_NO_THROW(snapped(T::Point, 1e18));
  EXPECT_NO_THROW(snapped(T::Directional, 1.5707));
  expectSceneError([&] { snapped(T::Directional, 1e9); }, {"'sun'", "radius", "in radians, from 0 to pi/2"});
  expectSceneError([&] { snapped(T::Point, -1); }, {"'sun'", "radius is -1"});
  expectSceneError([&] { snapped(T::Point, std::numeric_limits<double>::quiet_NaN()); },
                   {"'sun'", "radius is nan"});
}

TEST(Snapshot, CameraIsTheNamedOneTheFirstOneOrAFittedOne) {
  Scene scene = plain();
  const CameraId second = scene.add(Camera{.name = "second", .eye = Vec3(0, 3, 9)});
  expectNear(takeSnapshot(scene, 0, {100, 100}).view.eye, {0, 0, 5}, 0);
  expectNear(takeSnapshot(scene, 0, {100, 100}, second).view.eye, {0, 3, 9}, 0);
  expectNear(takeSnapshot(scene, 0, {100, 100}, Camera{.eye = Vec3(1, 1, 1)}).view.eye, {1, 1, 1}, 0);

  Scene bare;  // a moving scene without a camera: fitted at the default time, so that the picture does not
               // breathe
  bare.add(Node{.translation = [](double t) { return Vec3(t, 0, 0); }, .surface = sphere(1)});
  const View still = snap(bare, 0).view;
  EXPECT_TRUE(still == snap(bare, 7).view);
  const Vec2 middle =
      pixelFromEye(still, eyeFromWorldPoint(still, Vec3(0)));  // where the ball is at that time
  EXPECT_NEAR(middle.x, 50, 0.5);                              // samples of a ball are not as even as it is
  EXPECT_NEAR(middle.y, 50, 0.5);
}

TEST(Snapshot, AFormulaWithAPoleCanBeLookedAt) {
  Scene scene;
  scene.add(Node{.translation = Vec3(5, 0, 0),
                 .surface = surface([](auto u, auto v) { return point(u, 1 / u, v); }, {{-1, 1}, {0, 1}})});
  const Snapshot snapshot = takeSnapshot(scene, 0, {100, 100});
  EXPECT_FALSE(std::isfinite(snapshot.nodes[0].boundsWorld.extent().y))
      << "it has no end: it is never culled";
  // The fitted camera looks at where most of it is; nine tenths of 1 / u lie within 1 / 0.1 of the middle.
  const Vec3 toward = Vec3(5, 0, 0.5) - snapshot.view.eye;
  EXPECT_GT(glm::dot(unit(toward), snapshot.view.forward()), 0.99);
  EXPECT_LT(glm::length(toward), 200);
  // An orthographic one has a depth range.
  EXPECT_NO_THROW(static_cast<void>(
      takeSnapshot(scene, 0, {100, 100}, Camera{.projection = Projection::Orthographic, .height = 20})));
}

TEST(Snapshot, BoundsHoldEverySampledPoint) {
  test::Random random(5);
  for (int i = 0; i < 300; ++i) {
    Scene scene;
    const NodeId parent = scene.add(Node{.rotation = random.rotation(), .scale = random.scale()});
    scene.add(Node{.parent = parent,
                   .translation = random.inCube(10),
                   .rotation = random.rotation(),
                   .scale = random.scale(),
                   .surface = random.surface()});
    const SnapshotNode node = snap(scene).nodes[0];
    for (const Vec3& p : test::sample(node.surface, 12)) {
      ASSERT_TRUE(node.boundsObject.contains(p));
      ASSERT_TRUE(node.boundsWorld.contains(transformPoint(node.worldFromObject, p)));
    }
  }
}

// Shadows.

struct Lamp {
  Scene scene;
  NodeId shade;
};

Lamp lamp(const Vec3& scale = Vec3(1), Light light = {.shadow = Light::Shadow::Exact}, double height = 0.2) {
  Lamp lamp;
  lamp.shade = lamp.scene.add(Node{.name = "shade",
                                   .translation = Vec3(1, 2, 3),
                                   .rotation = Rotation{{1, 1, 0}, 0.7},
                                   .scale = scale,
                                   .surface = paraboloid(0.2, 1.8)});
  if (light.casters.empty()) light.casters = {lamp.shade};
  lamp.scene.add(
      Node{.name = "bulb", .parent = lamp.shade, .translation = Vec3(0, height, 0), .light = light});
  return lamp;
}

TEST(Snapshot, ShadeRuleFollowsTheHierarchy) {
  const auto [scene, shade] = lamp(Vec3(2));
  const SnapshotLight light = snap(scene).lights.at(0);
  ASSERT_TRUE(light.shade);
  const Mat3 r = rotation({1, 1, 0}, 0.7);
  expectNear(light.shade->vertex, {1, 2, 3}, 0);
  expectNear(light.shade->axis, r * Vec3(0, 1, 0), 1e-15);
  expectNear(light.shade->focus, Vec3(1, 2, 3) + 0.4 * (r * Vec3(0, 1, 0)), 1e-15);
  expectNear(light.shade->focus, Vec3(light.positionWorld), 1e-15);
  EXPECT_DOUBLE_EQ(light.shade->cosRim, 0.8);
  EXPECT_DOUBLE_EQ(light.shade->focalLength, 0.4);
  EXPECT_DOUBLE_EQ(light.shade->height, 3.6);
  EXPECT_EQ(light.shade->caster, shade);
  EXPECT_EQ(light.casters, std::vector{shade});
}

TEST(Snapshot, InvisibleShadesCastNoShadow) {
  auto [scene, shade] = lamp();
  Node hidden = scene[shade];
  hidden.surface = {};
  scene.set(shade, hidden);
  EXPECT_FALSE(snap(scene).lights.at(0).shade);
}

TEST(Snapshot, ShadowsWithoutAClosedFormHaveTheirCasters) {
  using S = Light::Shadow;
  const auto castersOf = [](const Lamp& lamp) {
    const SnapshotLight light = snap(lamp.scene).lights.at(0);
    EXPECT_FALSE(light.shade);
    EXPECT_TRUE(light.hasShadow());
    return light.casters;
  };
  for (const Lamp& one : {lamp(Vec3(1), {.type = Light::Type::Directional, .shadow = S::Exact}),
                          lamp(Vec3(1), {.shadow = S::Exact}, 0.2001), lamp(Vec3(1, 1, 1.01))})
    EXPECT_EQ(castersOf(one), std::vector{one.shade});

  Lamp two = lamp();
  const NodeId wall = two.scene.add(Node{.name = "wall", .surface = rectangle(1, 1)});
  Node bulb = two.scene[*two.scene.findNode("bulb")];
  const auto castersGiven = [&](std::vector<NodeId> casters) {
    bulb.light->casters = std::move(casters);
    two.scene.set(*two.scene.findNode("bulb"), bulb);
    return castersOf(two);
  };
  const std::vector both{two.shade, wall};
  EXPECT_EQ(castersGiven({wall, two.shade, wall}), both);
  EXPECT_EQ(castersGiven({wall}), std::vector{wall});
  EXPECT_EQ(castersGiven({}), both);  // everything
}

/// Held against exact shadows: as many points as would stand for the light.
TEST(Snapshot, AMapIsOneLightAndItsTruthAreItsPoints) {
  using S = Light::Shadow;
  Light light;
  light.shadow = S::Map;
  light.radius = 0.1;
  light.shadowSamples = 9;
  light.map.size = 64;
  const Snapshot map = snap(lamp(Vec3(1), light).scene);
  ASSERT_EQ(map.lights.size(), 1U);
  ASSERT_TRUE(map.lights[0].map);
  EXPECT_EQ(map.lights[0].map->size, 64U);
  EXPECT_EQ(map.lights[0].map->radius, 0.1);
  EXPECT_EQ(approximateShadows(map), 1U);
  const Snapshot exact = withExactShadows(map);
  EXPECT_EQ(exact.lights.size(), 9U);
  EXPECT_EQ(approximateShadows(exact), 0U);
  EXPECT_EQ(withoutShadowMaps(map), exact);
  // A planar one is its points from the beginning.
  Light ofPlane = light;
  ofPlane.shadow = S::Planar;
  Lamp planar = lamp(Vec3(1), ofPlane);
  const NodeId plane = planar.scene.add(Node{.translation = Vec3(0, -5, 0), .surface = rectangle(40, 40)});
  Node bulb = planar.scene[*planar.scene.findNode("bulb")];
  bulb.light->shadowPlane = plane;
  planar.scene.set(*planar.scene.findNode("bulb"), bulb);
  const Snapshot points = snap(planar.scene);
  EXPECT_EQ(points.lights.size(), 9U);
  EXPECT_EQ(approximateShadows(points), 1U);
  for (const SnapshotLight& point : exact.lights)
    EXPECT_EQ(point.pointOf, (WidePlace{map.lights[0].positionWorld, 0.1}));
  ASSERT_EQ(wholeLights(exact).size(), 1U);
  EXPECT_NEAR(wholeLights(exact)[0].light.radiance.x, map.lights[0].radiance.x, 1e-12);
  light.map.pcf = 4;
  expectSceneError([&] { (void)lamp(Vec3(1), light); }, {"bulb", "pcf", "odd"});
  light.map = {};
  light.map.bias = [](double) { return -1.0; };
  expectSceneError([&] { (void)snap(lamp(Vec3(1), light).scene); }, {"bulb", "bias", "-1"});
}

TEST(Snapshot, PlanarShadowsFallOnWhatIsOpaque) {
  const auto scene = [](bool glassFloor) {
    Scene planar;
    const MaterialId glass = planar.add(Material{.opacity = 0.5});
    const NodeId floor = planar.add(
        Node{.name = "floor", .surface = rectangle(1, 1), .material = glassFloor ? glass : MaterialId{}});
    planar.add(Node{.name = "pane", .surface = rectangle(1, 1), .material = glass});
    planar.add(Node{.translation = Vec3(0, 5, 0),
                    .light = Light{.shadow = Light::Shadow::Planar, .shadowPlane = floor}});
    return planar;
  };
  const Snapshot planar = snap(scene(false));
  ASSERT_EQ(planar.lights.size(), 1U);
  EXPECT_EQ(withoutShadowMaps(planar), planar) << "it is on its plane alone";
  EXPECT_FALSE(withExactShadows(planar).lights[0].plane);
  expectSceneError([&] { (void)snap(scene(true)); }, {"floor", "plane of a planar shadow"});
}

TEST(Snapshot, AShadeThatIsSeenThroughIsACasterLikeOthers) {
  Lamp glass = lamp();
  ASSERT_TRUE(snap(glass.scene).lights[0].shade);
  Node shade = glass.scene[glass.shade];
  shade.material = glass.scene.add(Material{.opacity = 0.5});
  glass.scene.set(glass.shade, shade);
  const SnapshotLight light = snap(glass.scene).lights[0];
  EXPECT_FALSE(light.shade);
  EXPECT_EQ(light.casters, std::vector{glass.shade});
}

TEST(Snapshot, CutsOffWhatFormulasMakeTooBrightAndCountsIt) {
  const auto bright = [](double t) { return 1e17 * t; };
  Scene scene;
  scene.add(Animated<Material>([=](double t) {
    return Material{.diffuse = {bright(t), 0.5, 0}, .specular = Vec3(bright(t)), .shininess = bright(t)};
  }));
  scene.add(Node{.light = Light{.color = [](double t) { return Vec3(t, 1, 1); }, .intensity = bright}});
  const Snapshot within = takeSnapshot(scene, 1, {64, 48}), beyond = takeSnapshot(scene, 100, {64, 48});
  EXPECT_EQ(within.cutNumbers, 0u);
  EXPECT_EQ(within.materials[1].diffuse, Vec3(1e17, 0.5, 0));
  EXPECT_EQ(beyond.materials[1].diffuse, Vec3(kMaxSceneNumber, 0.5, 0));
  EXPECT_EQ(beyond.materials[1].shininess, kMaxSceneNumber);
  EXPECT_EQ(beyond.lights[0].radiance, Vec3(kMaxReflected / kMaxSceneNumber));
  EXPECT_EQ(beyond.cutNumbers, 8u);  // diffuse, 3 of specular, shininess, 3 of the light they reflect

  Scene still;
  test::expectSceneError([&] { still.add(Material{.name = "lit", .diffuse = Vec3(1e39)}); },
                         {"lit", "1e+18"});
  test::expectSceneError(
      [&] { still.add(Node{.name = "sun", .light = Light{.color = Vec3(1e16), .intensity = 1e16}}); },
      {"sun", "color * intensity", "1e+30"});
}

}  // namespace
}  // namespace luxo
