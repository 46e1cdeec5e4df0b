// SPDX-License-Identifier: Apache-2.0
// Built-in scenes from random cameras against the ground truth, a few of each, the same every time: `luxo
// verify SCENE --random N --seed S` looks through as many others as one likes.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <string_view>

#include "draw/device_cloth_simulation.h"
#include "random/run.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "scenes/embedded_scenes.h"
#include "scenes/gallery.h"
#include "support/picture.h"

namespace luxo::test {
namespace {

constexpr std::uint64_t kSeed = 2617, kCameras = 3;

class RandomCameras : public PictureTest, public testing::WithParamInterface<std::string_view> {};

INSTANTIATE_TEST_SUITE_P(All, RandomCameras,
                         testing::Values("luxo-grandpa", "klein", "gallery/steel", "gallery/cloth"));

Scene sceneNamed(std::string_view name) {
  const auto described = [&] {
    for (const EmbeddedScene& one : galleryScenes())
      if (one.name == name) return galleryDescription(one);
    const auto plain = std::ranges::find(embeddedScenes(), name, &EmbeddedScene::name);
    return parseScene(std::string(plain->text), std::string(name));
  };
  return buildScene(described());
}

/// With 1 and with 4 samples, with shaders of materials (whose colours have no truth) and without.
TEST_P(RandomCameras, SeeNoPixelSilentlyWrong) {
  Scene scene = sceneNamed(GetParam());
  scene.set(std::make_shared<DeviceClothSimulation>(context()));
  for (const int samples : {1, 4}) {
    const random::RunTotals totals = random::runRandom(
        renderer(), {.count = kCameras,
                     .seed = kSeed,
                     .options = {.size = PixelSize{64 / samples, 48 / samples}, .samples = samples},
                     .scene = &scene,
                     .print = [](const std::string&) {}});
    EXPECT_EQ(totals.silentlyWrong, 0U)
        << "luxo verify " << GetParam() << " --random " << kCameras << " --seed " << kSeed << " --samples "
        << samples << " --size " << 64 / samples << "x" << 48 / samples;
    EXPECT_EQ(totals.scenes, kCameras);
    EXPECT_GT(totals.hits, 200U);
  }
}

// What takes longer than its limit is told, and is no success of which nobody knows.
TEST_F(PictureTest, RandomScenesThatTakeTooLongAreUnjudged) {
  std::string lines;
  const random::RunTotals totals =
      random::runRandom(renderer(), {.count = 2,
                                     .seed = kSeed,
                                     .first = 1,
                                     .options = {.size = PixelSize{8, 6}, .samples = 1},
                                     .limitSeconds = 0,
                                     .print = [&](const std::string& line) { lines += line; }});
  EXPECT_EQ(totals.scenes, 2U);
  EXPECT_EQ(totals.slowScenes, 2U);
  EXPECT_EQ(totals.pixels, 0U);
  EXPECT_EQ(std::ranges::count(lines, '\n'), 2);
  EXPECT_NE(lines.find(R"("unjudged":"stopped after 0 s of CPU")"), std::string::npos) << lines;
}

}  // namespace
}  // namespace luxo::test
