// SPDX-License-Identifier: Apache-2.0
// Spots: what their cones leave of their light, and where they are said, in C++ and in files.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "reference/explained_pixel.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "scene/scene_writer.h"
#include "scene/snapshot.h"
#include "scene_test_support.h"
#include "surface/library.h"

namespace luxo {
namespace {

using test::expectNear;
using test::expectSceneError;

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

/// Off the axis -Z by that angle, of any length.
Vec3 offAxis(double angle) {
  return 7.0 * Vec3(std::sin(angle) * 0.6, std::sin(angle) * 0.8, -std::cos(angle));
}

/// KHR_lights_punctual's own words.
double recommended(double angle, double inner, double outer) {
  const double part =
      std::clamp((std::cos(angle) - std::cos(outer)) / (std::cos(inner) - std::cos(outer)), 0.0, 1.0);
  return part * part;
}

TEST(SpotCone, IsTheRecommendedFormula) {
  for (const auto& [inner, outer] :
       {std::pair(0.0, kPi / 4), {0.2, 0.5}, {0.0, kPi / 2}, {1.5, kPi / 2}, {0.3, 0.31}}) {
    const SpotCone cone{.inner = inner, .outer = outer};
    EXPECT_EQ(spotAttenuation(cone, offAxis(0)), 1);
    EXPECT_NEAR(spotAttenuation(cone, offAxis(inner)), 1, 1e-12);
    EXPECT_NEAR(spotAttenuation(cone, offAxis(outer)), 0, 1e-12);
    const double middle = (inner + outer) / 2;
    EXPECT_NEAR(spotAttenuation(cone, offAxis(middle)), recommended(middle, inner, outer), 1e-12);
    EXPECT_GT(spotAttenuation(cone, offAxis(middle)), 0.2);
    for (const double beyond : {outer + 1e-6, outer + 0.1, 2.0, kPi})
      EXPECT_EQ(spotAttenuation(cone, offAxis(beyond)), 0) << beyond;
    for (int k = 0; k <= 100; ++k)
      EXPECT_NEAR(spotAttenuation(cone, offAxis(k * kPi / 100)), recommended(k * kPi / 100, inner, outer),
                  1e-12);
  }
}

// Of angles whose cosines differ by nothing in double: cos a = 1 - a^2 / 2.
TEST(SpotCone, NarrowOnesAreAsGood) {
  const SpotCone cone{.inner = 1e-9, .outer = 3e-9};
  for (const double angle : {0.5e-9, 1.5e-9, 2e-9, 2.5e-9, 4e-9}) {
    const double part = std::clamp((9e-18 - angle * angle) / (9e-18 - 1e-18), 0.0, 1.0);
    EXPECT_NEAR(spotAttenuation(cone, offAxis(angle)), part * part, 1e-6) << angle;
  }
}

Scene spotScene(const Light& light, Node node = {}) {
  Scene scene;
  scene.add(Node{.surface = sphere(1)});
  node.name = "lamp";
  node.light = light;
  scene.add(std::move(node));
  return scene;
}

SnapshotLight spotOf(const Scene& scene, double time = 0) {
  return takeSnapshot(scene, time, {64, 64}).lights.at(0);
}

TEST(Spot, ShinesAlongItsNodesAxis) {
  const Light light{.spot = Spot{0.1, 0.4}};
  const SnapshotLight plain = spotOf(spotScene(light, {.translation = Vec3(1, 2, 3)}));
  EXPECT_EQ(plain.positionWorld, Vec4(1, 2, 3, 1));
  EXPECT_EQ(plain.cone, (SpotCone{{0, 0, -1}, 0.1, 0.4}));
  EXPECT_EQ(plain.coneTo({1, 2, -5}), 1);
  EXPECT_EQ(plain.coneTo({1, 2, 9}), 0);
  // A quarter turn about X takes -Z to +Y; lengths of the scale do not matter, its mirroring does.
  const Rotation up{{1, 0, 0}, kPi / 2};
  expectNear(spotOf(spotScene(light, {.rotation = up, .scale = Vec3(3, 0.1, 7)})).cone->axis, {0, 1, 0},
             1e-15);
  expectNear(spotOf(spotScene(light, {.rotation = up, .scale = Vec3(1, 1, -2)})).cone->axis, {0, -1, 0},
             1e-15);
  EXPECT_FALSE(spotOf(spotScene(Light{})).cone);
}

TEST(Spot, MovesWithTime) {
  const Light light{.spot = Spot{[](double t) { return 0.1 * t; }, [](double t) { return 0.3 + 0.1 * t; }}};
  EXPECT_TRUE(light.movesWithTime());
  EXPECT_FALSE((Light{.spot = Spot{}}.movesWithTime()));
  const Scene scene = spotScene(light);
  EXPECT_TRUE(scene.movesWithTime());
  EXPECT_EQ(spotOf(scene, 2).cone->inner, 0.2);
  EXPECT_EQ(spotOf(scene, 2).cone->outer, 0.5);
  const Snapshot early = takeSnapshot(scene, 1, {64, 64}), late = takeSnapshot(scene, 2, {64, 64});
  EXPECT_FALSE(early.lights == late.lights);
  EXPECT_FALSE(early == late);
}

TEST(Spot, ItsShadowsPointsAllHaveItsCone) {
  Light light{.spot = Spot{0.1, 0.4}, .shadow = Light::Shadow::Exact, .radius = 0.2, .shadowSamples = 9};
  const auto lights = takeSnapshot(spotScene(light), 0, {64, 64}).lights;
  ASSERT_EQ(lights.size(), 9U);
  for (const SnapshotLight& one : lights) EXPECT_EQ(one.cone, (SpotCone{{0, 0, -1}, 0.1, 0.4}));
  light.shadow = Light::Shadow::Map;
  const Snapshot mapped = withoutShadowMaps(takeSnapshot(spotScene(light), 0, {64, 64}));
  ASSERT_EQ(mapped.lights.size(), 9U);
  for (const SnapshotLight& one : mapped.lights) EXPECT_EQ(one.cone, (SpotCone{{0, 0, -1}, 0.1, 0.4}));
}

TEST(Spot, LightsThatDifferInTheirConesAloneHaveAnOrder) {
  const std::vector<Node> nodes = {
      Node{.light = Light{}}, Node{.light = Light{.spot = Spot{}}},
      Node{.light = Light{.spot = Spot{0.1, 0.4}}}, Node{.light = Light{.spot = Spot{0.1, 0.3}}},
      Node{.rotation = Rotation{{1, 0, 0}, 1}, .light = Light{.spot = Spot{0.1, 0.4}}}};
  const auto conesOf = [&](const std::vector<int>& order) {
    Scene scene;
    for (const int i : order) scene.add(nodes[static_cast<std::size_t>(i)]);
    std::vector<std::optional<SpotCone>> cones;
    for (const SnapshotLight& light : takeSnapshot(scene, 0, {64, 64}).lights) cones.push_back(light.cone);
    return cones;
  };
  std::vector<int> order = {0, 1, 2, 3, 4};
  const auto expected = conesOf(order);
  EXPECT_FALSE(expected.front());
  while (std::next_permutation(order.begin(), order.end())) EXPECT_EQ(conesOf(order), expected);
}

TEST(Spot, RefusesWhatIsNoCone) {
  const auto light = [](double inner, double outer) { return Light{.spot = Spot{inner, outer}}; };
  for (const std::pair<double, double>& angles :
       {std::pair(0.4, 0.4), {0.5, 0.4}, {-0.1, 0.4}, {kNoNumber, 0.4}, {kPi / 2, kPi / 2}})
    expectSceneError([&] { spotScene(light(angles.first, angles.second)); },
                     {"'lamp'", "inner angle", "below the outer one"});
  for (const std::pair<double, double>& angles :
       {std::pair(0.0, 1.571), {0.0, 0.0}, {-2.0, -1.0}, {0.0, kNoNumber}, {0.1, 1e300}})
    expectSceneError([&] { spotScene(light(angles.first, angles.second)); },
                     {"'lamp'", "outer angle", "90 degrees"});
  EXPECT_NO_THROW(spotScene(light(0, kPi / 2)));
  EXPECT_NO_THROW(spotScene(light(0, 1e-9)));
  expectSceneError([] { spotScene({.type = Light::Type::Directional, .spot = Spot{}}); },
                   {"'lamp'", "directional light has no cone"});
  // What moves is looked at when it is asked for.
  const Scene narrows = spotScene({.spot = Spot{0.2, [](double t) { return 0.5 - 0.1 * t; }}});
  EXPECT_NO_THROW(spotOf(narrows, 2));
  expectSceneError([&] { spotOf(narrows, 4); }, {"'lamp'", "inner angle of its spot is 0.2"});
  expectSceneError([] { spotOf(spotScene({.spot = Spot{}}, {.scale = Vec3(1, 1, 0)})); },
                   {"'lamp'", "no direction"});
}

/// A floor of diffuse colour 0.5, 4 metres below a spot that shines down, of intensity 8 and inverse square,
/// seen from the side through the point (x, 0, 0).
LightOnPoint onFloor(double x) {
  Scene scene;
  scene.set(RenderSettings{.ambient = Vec3(0)});
  scene.add(Camera{.eye = Vec3(x, 5, 9), .lookAt = Vec3(x, 0, 0), .fovY = 0.7});
  const MaterialId grey = scene.add(Material{.diffuse = Vec3(0.5), .specular = Vec3(0)});
  scene.add(Node{.surface = rectangle(40, 40), .material = grey});
  scene.add(Node{.translation = Vec3(0, 4, 0),
                 .rotation = Rotation{{1, 0, 0}, -kPi / 2},
                 .light = Light{.intensity = 8,
                                .attenuation = Light::Attenuation::InverseSquare,
                                .spot = Spot{radians(20), radians(40)},
                                .shadow = Light::Shadow::Exact}});
  const ExplainedPixel pixel = explainPixel(takeSnapshot(scene, 0, {64, 48}), {32, 24});
  expectNear(pixel.points.at(0).position, {x, 0, 0}, 1e-12);
  return pixel.points.at(0).lights.at(0);
}

TEST(Spot, TheGroundTruthKnowsWhatItGives) {
  const LightOnPoint axis = onFloor(0);
  EXPECT_EQ(axis.cone, 1);
  expectNear(axis.share, Vec3(0.5 * 8 / 16), 1e-12);
  const double angle = radians(30), x = 4 * std::tan(angle), distance = 4 / std::cos(angle);
  const LightOnPoint middle = onFloor(x);
  const double cone = recommended(angle, radians(20), radians(40));
  EXPECT_NEAR(middle.cone, cone, 1e-12);
  expectNear(middle.share, Vec3(0.5 * 8 * cone * std::cos(angle) / (distance * distance)), 1e-12);
  expectNear(middle.unshadowed, middle.share, 0);
  const LightOnPoint outside = onFloor(-4 * std::tan(radians(40.001)));
  EXPECT_EQ(outside.cone, 0);
  EXPECT_EQ(outside.share, Vec3(0));
  EXPECT_TRUE(outside.faces);
}

std::string lightFile(const std::string& light) {
  return "{ \"luxo\": 1,\n\"nodes\": [ { \"name\": \"lamp\", \"light\": " + light + " } ] }";
}

TEST(SpotFile, SaysAsMuchAsItHasTo) {
  const auto built = [](const std::string& light) { return buildScene(parseScene(lightFile(light), "s")); };
  const Light usual = *built(R"({ "spot": {} })")[NodeId{0}].light;
  EXPECT_EQ(usual.spot->inner.at(0), 0);
  EXPECT_NEAR(usual.spot->outer.at(0), kPi / 4, 1e-15);
  const Light moving =
      *built(R"({ "type": "point", "spot": { "inner": "t*deg", "outer": "(30+t)*deg" } })")[NodeId{0}].light;
  EXPECT_NEAR(moving.spot->inner.at(2), radians(2), 1e-15);
  EXPECT_NEAR(moving.spot->outer.at(2), radians(32), 1e-15);
  EXPECT_TRUE(moving.movesWithTime());
  EXPECT_FALSE(built("{}")[NodeId{0}].light->spot);
  for (const char* light :
       {R"({ "spot": {} })", R"({ "spot": { "inner": "20deg", "outer": 0.5 }, "intensity": 3 })"}) {
    const SceneFile file = parseScene(lightFile(light), "s");
    EXPECT_EQ(parseScene(writeScene(file), "s"), file) << writeScene(file);
    SceneFile other = file;
    other.nodes[0].light->spot->outer = 0.25;
    EXPECT_FALSE(other == file);
    other.nodes[0].light->spot.reset();
    EXPECT_FALSE(other == file);
  }
}

TEST(SpotFile, MistakesAreToldWhereTheyAre) {
  struct BadSpot {
    const char *light, *where, *message, *help;
  };
  for (const auto& [light, where, message, help] :
       {BadSpot{R"({ "spot": { "inner": "40deg", "outer": "30deg" } })", "2:60",
                "the inner angle is 40 degrees", "fades"},
        {R"({ "spot": { "inner": "30deg", "outer": "30deg" } })", "2:60",
         "the inner angle is 30 degrees, the outer one 30", ""},
        {R"({ "spot": { "inner": "50deg" } })", "2:60", "the inner angle is 50 degrees, the outer one 45",
         ""},
        {R"({ "spot": { "inner": "-1deg" } })", "2:61", "this is -0.01745", "from 0 to 90 degrees"},
        {R"({ "spot": { "outer": 30 } })", "2:60", "this is 30 radians", "write \"30deg\""},
        {R"({ "spot": { "outer": 0 } })", "2:60", "this is 0 radians", ""},
        {R"({ "spot": { "outer": "0/0" } })", "2:61", "this is not a number", "90 degrees"},
        {R"({ "spot": { "outer": "91deg" } })", "2:61", "this is 1.588", "90 degrees"},
        {R"({ "spot": { "iner": 0.1 } })", "2:51", "unknown key \"iner\" in a spot", "'inner'"},
        {R"({ "spot": 30 })", "2:49", "expected", ""},
        {R"({ "type": "directional", "spot": {} })", "2:72", "a directional light has no cone",
         "\"type\": \"point\""},
        {R"({ "type": "spot" })", "2:49", "unknown word 'spot'", "\"outer\": \"30deg\""}}) {
    try {
      const Scene scene = buildScene(parseScene(lightFile(light), "s"));
      static_cast<void>(takeSnapshot(scene, 0, {64, 64}));
      ADD_FAILURE() << "taken: " << light;
    } catch (const Error& error) {
      const std::string told = error.what(), start = fmt::format("s:{}: {}", where, message);
      EXPECT_EQ(told.substr(0, start.size()), start) << light << "\n" << told;
      EXPECT_NE((told + error.hint()).find(help), std::string::npos) << told;
      EXPECT_NE(told.find('^'), std::string::npos) << told;
      EXPECT_EQ(told.find("\ns:"), std::string::npos) << "more than one in\n" << told;
    }
  }
}

}  // namespace
}  // namespace luxo
