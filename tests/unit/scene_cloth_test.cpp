// SPDX-License-Identifier: Apache-2.0
// Cloth in scenes: what its numbers may be and where it is said that they may not, its triangles at rest, its
// steps, and what a scene without a device does. How it moves: tests/gpu/cloth_test.cpp.
#include <gmock/gmock.h>

#include <fmt/format.h>

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "scene/snapshot.h"
#include "surface/cloth_simulation.h"
#include "surface/surface_triangles.h"

namespace luxo {
namespace {

using testing::HasSubstr;

std::string messageOf(const auto& action) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::Scene);
    return std::string(error.what()) + " | " + error.hint();
  }
  return "nothing is wrong";
}

std::string sceneWith(const std::string& members) {
  return fmt::format(
      "{{ \"luxo\": 1, \"params\": {{ \"k\": {{ \"value\": 60, \"range\": [0, 1e9] }} }},\n"
      "\"surfaces\": {{ \"s\": {{ \"type\": \"cloth\", {} }} }},\n"
      "\"nodes\": [ {{ \"name\": \"flag\", \"surface\": \"s\" }} ] }}",
      members);
}

Scene built(const std::string& members) { return buildScene(parseScene(sceneWith(members), "s")); }

TEST(SceneCloth, SaysWhereWhatIsWrong) {
  const struct {
    const char *members, *place, *message;
  } wrong[] = {
      {R"("cells": [0, 4])", "s:2:49", "it must be a whole number from 1 to 128"},
      {R"("cells": [4, 1e9])", "s:2:52", "it must be a whole number from 1 to 128"},
      {R"("cells": [4, 2.5])", "s:2:52", "this is 2.5; it must be a whole number"},
      {R"("cells": ["k", 4])", "s:2:50", "cannot depend on t or on parameters"},
      {R"("step": -0.001)", "s:2:47", "it must be from 0.00001 to 0.1 s"},
      {R"("step": "0/0")", "s:2:48", "not a number"},
      {R"("density": 0)", "s:2:50", "it must be from 0.001 to 1000 kg/m^2"},
      {R"("stretch": "60 + t")", "s:2:51", "a cloth's numbers cannot depend on t"},
      {R"("stretch": "-k")", "s:2:51", "at time 0 this is -60; it must be from 0.001 to 1e6 N/m"},
      {R"("size": [1, 1e300])", "s:2:51", "it must be from 0.001 to 1000 m"},
      {R"("gravity": [0, 1e9, 0])", "s:2:54", "it must be from -1000 to 1000 m/s^2"},
      {R"("pins": [[0.5, 2]])", "s:2:54", "it must be from 0 to 1"},
      {R"("ball": { "radius": -1 })", "s:2:59", "it must be from 0 to 1000 m"},
      {R"("stretch": 1e6, "step": 0.1)", "s:2:63",
       "a step of 0.1 s is too long for how stiff and light a cloth is"},
  };
  for (const auto& [members, place, message] : wrong) {
    const std::string said = messageOf([&, text = members] { static_cast<void>(built(text)); });
    EXPECT_THAT(said, HasSubstr(place)) << members;
    EXPECT_THAT(said, HasSubstr(message)) << members;
  }
}

// A step that is too long without being written: of what makes it so.
TEST(SceneCloth, SaysThatTheUsualStepIsTooLong) {
  EXPECT_THAT(messageOf([] { static_cast<void>(built(R"("stretch": 1e6, "density": 0.001)")); }),
              HasSubstr("shorten \"step\""));
}

TEST(SceneCloth, ValidatesWhatIsMadeInCpp) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto said = [](const Cloth& cloth) { return messageOf([&] { validate(cloth); }); };
  EXPECT_THAT(said({.columns = 0}), HasSubstr("a cloth of 0 x 24 cells; each number must be from 1 to 128"));
  EXPECT_THAT(said({.pins = {{nan, 0}}}), HasSubstr("a cloth is pinned at u = nan, v = 0"));
  EXPECT_THAT(said({.stretch = nan}), HasSubstr("the stretch of a cloth is nan"));
  EXPECT_THAT(said({.step = 0.1}), HasSubstr("too long"));
  EXPECT_EQ(said({}), "nothing is wrong");
}

TEST(SceneCloth, LiesFlatAtRest) {
  const Scene scene = built(R"("cells": [3, 2], "size": [0.6, 0.8])");
  const Snapshot snapshot = takeSnapshot(scene, 0, {64, 64});
  ASSERT_EQ(snapshot.nodes.size(), 1U);
  const Surface& surface = snapshot.nodes[0].surface;
  ASSERT_TRUE(surface.isPolygonal());
  EXPECT_FALSE(surface.isParametric());
  EXPECT_EQ(surface.triangles()->count, 12U);
  EXPECT_EQ(surface.flatNormal(), Vec3(0, 1, 0));
  EXPECT_EQ(surface.domain().u.hi, 1);
  EXPECT_EQ(snapshot.nodes[0].boundsObject.min, Vec3(Vec3f(-0.3F, 0, -0.4F)));
  EXPECT_TRUE(snapshot.nodes[0].parameters.empty());
  EXPECT_TRUE(scene.movesWithTime());
  EXPECT_TRUE(takeSnapshot(scene, -5, {64, 64}) == takeSnapshot(scene, 0.0005, {64, 64}))
      << "before the first step";
}

// What asks for a later time is told.
TEST(SceneCloth, WithoutADeviceItDoesNotMove) {
  const Scene scene = built(R"("pins": ["back"])");
  EXPECT_THAT(messageOf([&] {
                static_cast<void>(takeSnapshot(scene, 1, {64, 64}));
              }),
              HasSubstr("node 'flag' at time 1: cloth moves on a device"));
}

TEST(SceneCloth, ItsParametersStayInTheirRange) {
  Scene scene = built(R"("stretch": "k", "step": 0.001)");
  scene.setParameter(*scene.findParameter("k"), 1e9);
  EXPECT_THAT(messageOf([&] {
                static_cast<void>(takeSnapshot(scene, 0, {64, 64}));
              }),
              HasSubstr("it must be from 0.001 to 1e6 N/m"));
}

TEST(SceneCloth, StepsAreCountedFromZero) {
  const Cloth cloth{.step = 0.001};
  EXPECT_EQ(clothSteps(cloth, -1), 0U);
  EXPECT_EQ(clothSteps(cloth, 0.0009), 0U);
  for (std::uint32_t n = 0; n <= 5000; ++n) {
    ASSERT_EQ(clothSteps(cloth, n / 1000.0), n);
    ASSERT_EQ(clothSteps(cloth, n * 0.001), n);
    ASSERT_EQ(clothSteps(cloth, (n + 0.999) * 0.001), n);
  }
  EXPECT_THAT(
      messageOf([&] { static_cast<void>(clothSteps(cloth, 1e9)); }),
      HasSubstr(
          "time 1000000000 s is step 1000000000000 of a cloth; the last one that is simulated is 100000"));
}

TEST(SceneCloth, PinsAreCornersEdgesAndPoints) {
  const auto pinned = [](const std::string& pins) {
    const Scene scene = built(R"("cells": [3, 2], "pins": )" + pins);
    const ClothSystem system = clothSystem(*scene.nodes()[0].node.surface.triangles()->cloth);
    std::string shown;
    for (std::size_t i = 0; i < system.pinned.size(); ++i) shown += system.pinned[i] ? '#' : '.';
    return shown;
  };
  // From the front (+z) left (-x) on: rows of four points.
  EXPECT_EQ(pinned(R"(["front_left"])"), "#...........");
  EXPECT_EQ(pinned(R"(["front_right"])"), "...#........");
  EXPECT_EQ(pinned(R"(["back_left"])"), "........#...");
  EXPECT_EQ(pinned(R"(["back_right"])"), "...........#");
  EXPECT_EQ(pinned(R"(["front"])"), "####........");
  EXPECT_EQ(pinned(R"(["back"])"), "........####");
  EXPECT_EQ(pinned(R"(["left"])"), "#...#...#...");
  EXPECT_EQ(pinned(R"(["right"])"), "...#...#...#");
  EXPECT_EQ(pinned(R"([[0.4, 0.6], "front_left"])"), "#....#......");
}

}  // namespace
}  // namespace luxo
