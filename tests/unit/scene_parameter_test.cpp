// SPDX-License-Identifier: Apache-2.0
// Parameters: their values at a moment, who may read them, and what a change changes.
#include <array>
#include <cmath>
#include <limits>

#include "scene/snapshot.h"
#include "scene_test_support.h"

namespace luxo {
namespace {

using test::expectNear;
using test::expectSceneError;
using test::snap;

/// The value of parameter 0.
Animated<double> first() {
  return {[](const Moment& m) { return m.parameters[0]; }, DependsOn::Parameters};
}

/// A ball at height k in a light of intensity k, seen by a camera at distance k, all k = 3.
Scene turnable() {
  Scene scene;
  scene.add(Parameter{.name = "k", .label = "height", .value = 3, .range = Interval(1, 12), .step = 1});
  const auto vector = [](Vec3 direction) {
    return Animated<Vec3>([=](const Moment& m) { return m.parameters[0] * direction; },
                          DependsOn::Parameters);
  };
  const MaterialId grey = scene.add(Animated<Material>(
      [](const Moment& m) { return Material{.diffuse = Vec3(m.parameters[0])}; }, DependsOn::Parameters));
  scene.add(Node{.translation = vector({0, 1, 0}), .surface = sphere(1), .material = grey});
  scene.add(Node{.light = Light{.intensity = first()}});
  scene.add(Camera{.eye = vector({0, 0, 10})});
  return scene;
}

TEST(Parameters, ValuesMayUseThoseBeforeThemAndTime) {
  Scene scene;
  scene.add(Parameter{.name = "a", .value = 3});
  scene.add(Parameter{.name = "b", .value = [](double t) { return 2 * t; }});
  scene.add(Parameter{.name = "c", .value = [](const Moment& m) {
                        EXPECT_EQ(m.parameters.size(), 2u);
                        return m.parameters[0] + 10 * m.parameters[1] + 100 * m.time;
                      }});
  EXPECT_EQ(scene.parametersAt(0.5), (std::vector<double>{3, 1, 63}));
}

TEST(Parameters, EverythingAnimatedReadsThem) {
  const Snapshot snapshot = snap(turnable());
  EXPECT_EQ(snapshot.nodes[0].worldFromObject.translation, Vec3(0, 3, 0));
  EXPECT_EQ(snapshot.lights[0].radiance, Vec3(3));
  EXPECT_EQ(snapshot.materials[1].diffuse, Vec3(3));
  EXPECT_EQ(snapshot.view.eye, Vec3(0, 0, 30));
}

TEST(Parameters, CamerasZoomAndCutWithThem) {
  Scene scene;
  scene.add(Parameter{.name = "k", .value = 0.5});
  scene.add(Camera{.fovY = first(), .near = first()});
  EXPECT_EQ(snap(scene).view.near, 0.5);
  expectNear(Vec3(snap(scene).view.halfExtent, 0), {std::tan(0.25), std::tan(0.25), 0}, 1e-15);
  scene.set(CameraId{0}, Camera{.projection = Projection::Orthographic, .height = first()});
  EXPECT_EQ(snap(scene).view.halfExtent.y, 0.25);
}

TEST(Parameters, SettingOneChangesTheVersionAndTheNextSnapshotOnly) {
  Scene scene = turnable();
  const Snapshot before = snap(scene);
  const std::uint64_t version = scene.version();
  const ParameterId k = scene.findParameter("k").value();
  scene.setParameter(k, 4);
  EXPECT_GT(scene.version(), version);
  const Snapshot after = snap(scene);
  EXPECT_EQ(before.nodes[0].worldFromObject.translation.y, 3);
  EXPECT_EQ(after.nodes[0].worldFromObject.translation.y, 4);
  EXPECT_FALSE(before == after);
  EXPECT_FALSE(before.view == after.view || before.lights == after.lights ||
               before.materials == after.materials);
  scene.setParameter(k, 3);
  EXPECT_TRUE(snap(scene) == before) << "a picture remembers no earlier value";
}

TEST(Parameters, StandStillUnlessTheyMove) {
  Scene scene = turnable();
  EXPECT_FALSE(scene.movesWithTime());
  scene.setParameter(ParameterId{0}, [](double t) { return 2 + std::sin(t); });
  EXPECT_TRUE(scene.movesWithTime());
  EXPECT_FALSE(snap(scene, 0) == snap(scene, 1));
}

TEST(Parameters, AreFoundByName) {
  const Scene scene = turnable();
  EXPECT_EQ(scene.findParameter("k"), ParameterId{0});
  EXPECT_FALSE(scene.findParameter("q"));
  EXPECT_EQ(scene[ParameterId{0}].labelOrName(), "height");
  EXPECT_EQ(Parameter{.name = "q"}.labelOrName(), "q");
}

TEST(Parameters, OutOfRangeIsAnErrorThatSaysSo) {
  Scene scene = turnable();
  const ParameterId k{0};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double outside : {0.999, 12.001})
    expectSceneError([&] { scene.setParameter(k, outside); }, {"'k'", "range from 1 to 12"});
  expectSceneError([&] { scene.setParameter(k, nan); }, {"'k'", "nan", "finite"});
  EXPECT_EQ(scene.parametersAt(0)[0], 3) << "a refused value changes nothing";
  for (const double border : {1.0, 12.0}) EXPECT_NO_THROW(scene.setParameter(k, border));

  scene.setParameter(k, [](double t) { return 3 + t; });
  EXPECT_NO_THROW(snap(scene, 9));
  expectSceneError([&] { snap(scene, 9.5); }, {"'k'", "12.5", "range from 1 to 12"});
}

TEST(Parameters, BadDescriptionsAreRefused) {
  Scene scene;
  const auto refused = [&](Parameter parameter, const std::vector<std::string>& words) {
    expectSceneError([&] { scene.add(parameter); }, words);
  };
  refused({.name = "p", .value = 5, .range = Interval(0, 1)}, {"'p'", "5", "0 to 1"});
  refused({.name = "p", .range = Interval(1, 1)}, {"'p'", "empty"});
  refused({.name = "p", .range = Interval(0, INFINITY)}, {"'p'", "not finite"});
  refused({.name = "p", .step = 0}, {"'p'", "step", "above 0"});
  refused({.name = "p", .value = INFINITY}, {"'p'", "inf"});
  EXPECT_TRUE(scene.parameters().empty());
}

TEST(Parameters, AnimatedThingsAreCheckedAtEveryMoment) {
  Scene scene = turnable();
  scene.set(NodeId{1}, Node{.name = "lamp", .light = Light{.intensity = [](double t) { return 1 - t; }}});
  EXPECT_NO_THROW(snap(scene, 1));
  expectSceneError([&] { snap(scene, 2); }, {"lamp", "intensity", "-1"});
  scene.add(Animated<Material>([](double t) { return Material{.name = "glass", .opacity = t}; }));
  scene.set(NodeId{1}, Node{});
  expectSceneError([&] { snap(scene, 2); }, {"glass", "opacity", "2"});
}

}  // namespace
}  // namespace luxo
