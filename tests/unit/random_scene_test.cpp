// SPDX-License-Identifier: Apache-2.0
// The generator of hard scenes and what shrinks them, without a device.
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "base/error.h"
#include "random/crowd_scene.h"
#include "random/hard_scene.h"
#include "random/shrink.h"

namespace luxo::random {
namespace {

/// FNV-1a
std::uint64_t hashOf(const std::string& text) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  return hash;
}

TEST(HardScenes, ArePureFunctionsOfSeedAndIndex) {
  const Json scene = hardScene(5, 30, {}).json;
  EXPECT_EQ(hardScene(5, 30, {}).json, scene);
  EXPECT_NE(hardScene(6, 30, {}).json["surfaces"], scene["surfaces"]);
  EXPECT_NE(hardScene(5, 30 + surfaceKinds().size(), {}).json["surfaces"], scene["surfaces"]);
}

// On any machine, with any compiler: the surfaces' text, which plain arithmetic on the numbers decides.
TEST(HardScenes, NumbersAreTheSameEverywhere) {
  Numbers numbers(1, 2);
  EXPECT_EQ(numbers.next(), 5796968857530213156U);
  std::string all;
  for (const SurfaceKind& kind : surfaceKinds()) {
    Numbers n(7, 1);
    all += kind.make(n).dump();
  }
  EXPECT_EQ(hashOf(all), 7242377107141757811U);
}

TEST(HardScenes, EveryKindCanBeReadAndSeen) {
  std::set<std::string> cameras, dresses;
  for (std::uint64_t index = 0; index < 10 * surfaceKinds().size(); ++index) {
    const HardScene hard = hardScene(11, index, {});
    SCOPED_TRACE(hard.json.dump());
    EXPECT_TRUE(hard.kind.starts_with(kindAt(index)));
    const Scene scene = sceneOf(hard.json);
    EXPECT_NO_THROW(static_cast<void>(takeSnapshot(scene, 0, scene.settings().size)));
    cameras.insert(hard.camera);
    for (std::size_t plus = hard.kind.find('+'); plus != std::string::npos;) {
      const std::size_t next = hard.kind.find('+', plus + 1);
      dresses.insert(hard.kind.substr(plus, next - plus));
      plus = next;
    }
  }
  EXPECT_EQ(cameras.size(), 9U);
  EXPECT_EQ(dresses.size(), 4U + 3U + 2U + 1U) << "places, lights with shadows, glass, and fronts alone";
}

TEST(HardScenes, SizeAndSamplesAreTheCallers) {
  const HardScene hard = hardScene(1, 4, {.size = PixelSize{40, 30}, .samples = 4});
  const Scene scene = sceneOf(hard.json);
  EXPECT_EQ(scene.settings().size, (PixelSize{40, 30}));
  EXPECT_EQ(scene.settings().samples, 4);
}

TEST(CrowdScenes, CanBeReadAndHaveAllSortsOfLights) {
  std::set<std::string> lights;
  std::set<std::size_t> counts;
  for (std::uint64_t index = 0; index < 150; ++index) {
    const HardScene crowd = crowdScene(11, index, {});
    SCOPED_TRACE(crowd.json.dump());
    EXPECT_EQ(crowdScene(11, index, {}).json, crowd.json);
    const Scene scene = sceneOf(crowd.json);
    const Snapshot snapshot = takeSnapshot(scene, 0, scene.settings().size);
    EXPECT_GE(snapshot.nodes.size(), 3U);
    EXPECT_LE(snapshot.nodes.size(), 12U + 2U);
    for (const SnapshotLight& light : snapshot.lights) EXPECT_TRUE(light.hasShadow());
    counts.insert(snapshot.nodes.size());
    for (const Json& node : crowd.json["nodes"])
      if (node.contains("light")) lights.insert(node["light"].contains("radius") ? "soft" : "hard");
    for (const char* kind :
         {"low sun", "+sun", "direction", "far", "near", "inside", "grazing", "glass", "+spot", "+lamp"})
      if (crowd.kind.find(kind) != std::string::npos) lights.insert(kind);
  }
  EXPECT_EQ(lights.size(), 2U + 10U);
  EXPECT_GT(counts.size(), 8U);
}

// What fails here is any scene whose formula still has a cosine of u and whose picture still sees the origin.
TEST(Shrinking, LeavesWhatFailsAndLittleElse) {
  const Json scene = Json::parse(R"json({ "luxo": 1, "render": { "size": [160, 120], "samples": 4 },
    "materials": { "m": { "two_sided": true } },
    "surfaces": { "s": { "type": "formula", "u": [0, 6.2831], "v": [-1.25, 2.5],
                         "position": ["0.437*cos(6*u+0.55)+0.266*sin(5*u+v)", "v+0.5*sin(3.21*v)", "u"] },
                  "other": { "type": "sphere" } },
    "nodes": [ { "surface": "s", "material": "m", "rotate": { "axis": [1, 2, 3], "angle": 0.7 } },
               { "surface": "other" }, { "light": {} } ],
    "camera": { "eye": [0.1234567, 0.2, 5.4321], "look_at": [0, 0.01, 0], "up": [0.1, 1, 0], "near": 0.1, "fov_y": 0.8 } })json");
  int trials = 0;
  const Failure failure = [&](const Json& candidate) -> std::optional<Trial> {
    ++trials;
    std::optional<Scene> built;
    try {
      built.emplace(sceneOf(candidate));
    } catch (const Error&) {
      return std::nullopt;
    }
    const PixelSize size = built->settings().size;
    if (candidate["surfaces"].begin()->dump().find("cos(") == std::string::npos) return std::nullopt;
    const View view = takeSnapshot(*built, 0, size).view;
    const Vec2 pixel = pixelFromEye(view, eyeFromWorldPoint(view, Vec3(0)));
    if (!(pixel.x >= 0 && pixel.y >= 0 && pixel.x < size.width && pixel.y < size.height)) return std::nullopt;
    Trial trial{.size = size};
    trial.wrong.hitMiss = 1;
    trial.wrong.pixels = {static_cast<std::uint32_t>(pixel.y) * static_cast<std::uint32_t>(size.width) +
                          static_cast<std::uint32_t>(pixel.x)};
    return trial;
  };
  const auto first = failure(scene);
  ASSERT_TRUE(first);
  const Json small = shrunk(scene, *first, failure, {.trials = 400});
  SCOPED_TRACE(small.dump(1));
  EXPECT_TRUE(failure(small));
  EXPECT_LE(small["render"]["size"][0].get<int>() * small["render"]["size"][1].get<int>(), 64);
  EXPECT_EQ(small["render"]["samples"], 1);
  EXPECT_EQ(small["nodes"].size(), 1U);
  EXPECT_FALSE(small["nodes"][0].contains("rotate"));
  EXPECT_EQ(small["surfaces"].size(), 1U);
  EXPECT_LE(small["surfaces"]["s"]["position"].dump().size(), 30U);
  EXPECT_LE(trials, 402);  // and one before, and one after
}

TEST(Shrinking, StopsAtItsLimit) {
  const Json scene = hardScene(1, 0, {.samples = 1}).json;
  int trials = 0;
  const Failure never = [&](const Json&) -> std::optional<Trial> {
    ++trials;
    return std::nullopt;
  };
  Trial first;
  first.wrong.pixels = {0};
  Json same = shrunk(scene, first, never, {.trials = 7});
  same.erase("x-wrong");
  EXPECT_EQ(same, scene);
  EXPECT_EQ(trials, 7);
}

}  // namespace
}  // namespace luxo::random
