// SPDX-License-Identifier: Apache-2.0
// Sixty random hard scenes against the ground truth, small ones, the same every time:
// `luxo verify --random N --seed S` draws as many others as one likes.
#include <gtest/gtest.h>

#include <string>

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

}  // namespace
}  // namespace luxo::test
