// SPDX-License-Identifier: Apache-2.0
// Sixty random hard scenes and forty crowds in shadows against the ground truth, small ones, the same every
// time: `luxo verify --random N --seed S` (`--kind crowd`) draws as many others as one likes.
#include <gtest/gtest.h>

#include <string>

#include "random/crowd_scene.h"
#include "random/run.h"
#include "support/picture.h"

namespace luxo::test {
namespace {

constexpr std::uint64_t kSeed = 2, kScenes = 60, kParts = 6;
constexpr PixelSize kSize{32, 24};  // sixty scenes take about a minute of CPU

class HardScenes : public PictureTest, public testing::WithParamInterface<std::uint64_t> {};

INSTANTIATE_TEST_SUITE_P(Parts, HardScenes, testing::Range(std::uint64_t{0}, kParts));

TEST_P(HardScenes, HaveNoPixelSilentlyWrong) {
  std::uint64_t drawn = 0, hits = 0;
  for (std::uint64_t index = GetParam(); index < kScenes; index += kParts) {
    const random::RunTotals totals =
        random::runRandom(renderer(), {.count = 1,
                                       .seed = kSeed,
                                       .first = index,
                                       .options = {.size = kSize},
                                       .audit = {.extent = AuditExtent::None},  // which would mend it
                                       .print = [&](const std::string& line) {
                                         SCOPED_TRACE(line);
                                         EXPECT_EQ(line.find("\"error\""), std::string::npos);
                                       }});
    EXPECT_EQ(totals.silentlyWrong, 0U) << "luxo verify --random 1 --seed " << kSeed << " --first " << index
                                        << " --size " << kSize.width << "x" << kSize.height;
    drawn += totals.scenes;
    hits += totals.hits;
  }
  EXPECT_GT(drawn, kScenes / kParts / 2);
  EXPECT_GT(hits, 1000U);
}

// In two parts, as each makes what it knows of 35 surfaces anew: 20 s of CPU each.
constexpr std::uint64_t kCrowds = 40, kCrowdParts = 2;

class Crowds : public PictureTest, public testing::WithParamInterface<std::uint64_t> {};

INSTANTIATE_TEST_SUITE_P(Parts, Crowds, testing::Range(std::uint64_t{0}, kCrowdParts));

/// Three to twelve surfaces of the catalogue in the shadows of each other, from the usual map of 64 texels.
TEST_P(Crowds, HaveNoPixelWrong) {
  std::uint64_t drawn = 0, hits = 0;
  for (std::uint64_t index = GetParam(); index < kCrowds; index += kCrowdParts) {
    const random::RunTotals totals =
        random::runRandom(renderer(), {.count = 1,
                                       .seed = kSeed,
                                       .first = index,
                                       .kind = "crowd",
                                       .options = {.size = kSize, .samples = 1},
                                       .print = [&](const std::string& line) {
                                         SCOPED_TRACE(line);
                                         EXPECT_EQ(line.find("\"error\""), std::string::npos);
                                       }});
    EXPECT_EQ(totals.wrong, 0U) << "luxo verify --random 1 --kind crowd --samples 1 --seed " << kSeed
                                << " --first " << index << " --size " << kSize.width << "x" << kSize.height;
    drawn += totals.scenes;
    hits += totals.hits;
  }
  EXPECT_EQ(drawn, kCrowds / kCrowdParts);
  EXPECT_GT(hits, 1000U);
}

/// How large the maps of lights are, as far as their lists fit into memory, decides how long shadows take,
/// and no pixel. Of all forty of them the pictures were the same; these take little time, and have between
/// them a lamp, glass, light that is wide, far away, in a cone, and that grazes the floor.
TEST_F(PictureTest, CrowdsDoNotDependOnTheSizeOfTheirMaps) {
  constexpr PixelSize kLarger{64, 48};
  for (const std::uint64_t index : {1, 6, 8, 13, 24, 37}) {
    const random::HardScene crowd = random::crowdScene(kSeed, index, {.size = kLarger, .samples = 1});
    SCOPED_TRACE("crowd " + std::to_string(index) + ", " + crowd.kind);
    const Snapshot snapshot = takeSnapshot(random::sceneOf(crowd.json), 0, kLarger);
    const Image usual = renderer().render(snapshot).image;
    const Image lit =
        renderer()
            .render(snapshot, {.composition = Composition::Deferred, .shadows = ShadowKinds::None})
            .image;
    int dark = 0;
    for (int y = 0; y < kLarger.height; ++y)
      for (int x = 0; x < kLarger.width; ++x) dark += colorAt(usual, x, y).y < colorAt(lit, x, y).y - 0.01;
    EXPECT_GT(dark, 5) << "nothing is in shadow";
    for (const int texels : {32, 4096}) {
      const Picture other = renderer().render(snapshot, {.shadowGridSize = texels});
      EXPECT_TRUE(sameBytes(other.image, usual)) << texels;
      EXPECT_GT(other.statistics.count.tessellated, 0U) << "no map of " << texels << " texels was made";
      EXPECT_EQ(other.statistics.error.unconvergedPx + other.statistics.error.uncertifiedPx, 0U) << texels;
    }
  }
}

}  // namespace
}  // namespace luxo::test
