// SPDX-License-Identifier: Apache-2.0
// What passes and attempts cost adds up in their picture.
#include "draw/statistics.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>

namespace luxo {
namespace {

TEST(Statistics, PassesAddUpInTheirPicture) {
  FrameStatistics picture, pass;
  pass.ms = {.total = 9, .cull = 1, .gpu = 4};
  pass.count = {.nodes = 7, .drawn = 5, .culledSmall = 2, .triangles = 10, .submits = 1, .passes = 2};
  pass.error = {.tolerancePx = 0.5, .boundPx = 0.4, .unconvergedPx = 3};
  addPass(picture, pass);
  pass.count.drawn = 6;
  pass.count.culledSmall = 1;
  pass.error = {.tolerancePx = 0.5, .boundPx = 0.3, .residualMaxPx = 1e-4, .unconvergedPx = 5};
  addPass(picture, pass);
  EXPECT_EQ(picture.ms.cull, 2);
  EXPECT_EQ(picture.ms.gpu, 8);
  EXPECT_EQ(picture.ms.total, 0) << "the clock on the wall is its owner's to read";
  EXPECT_EQ(picture.count.nodes, 7u);
  EXPECT_EQ(picture.count.drawn + picture.count.culledSmall, 7u);
  EXPECT_EQ(picture.count.triangles, 20u);
  EXPECT_EQ(picture.count.submits, 2u);
  EXPECT_EQ(picture.count.passes, 4u);
  EXPECT_EQ(picture.error.boundPx, 0.4);
  EXPECT_EQ(picture.error.residualMaxPx, 1e-4);
  EXPECT_EQ(picture.error.unconvergedPx, 8u);
}

using EachCount = std::array<std::uint64_t, sizeof(FrameCounts) / sizeof(std::uint64_t)>;

// Whatever counts there are.
TEST(Statistics, EveryCountIsOfTheSceneOrAddsUp) {
  EachCount ones;
  ones.fill(1);
  const FrameStatistics pass{.count = std::bit_cast<FrameCounts>(ones)};
  FrameStatistics picture;
  addPass(picture, pass);
  EXPECT_EQ(std::bit_cast<EachCount>(picture.count), ones);
  addPass(picture, pass);
  const auto sums = std::bit_cast<EachCount>(picture.count),
             stay = std::bit_cast<EachCount>(shownAgain(pass).count);
  for (std::size_t i = 0; i < sums.size(); ++i) EXPECT_EQ(sums[i], stay[i] == 1 ? 1U : 2U) << i;
}

TEST(Statistics, AnotherAttemptIsMoreWorkForTheSamePicture) {
  FrameStatistics last{.ms = {.gpu = 3}, .count = {.nodes = 7, .drawCalls = 5, .submits = 1, .passes = 2}};
  const FrameStatistics first{.ms = {.total = 9, .gpu = 4},
                              .count = {.nodes = 7, .drawCalls = 6, .submits = 2, .passes = 3},
                              .error = {.unconvergedPx = 8}};
  addCost(last, first);
  EXPECT_EQ(last.ms.gpu, 7);
  EXPECT_EQ(last.ms.total, 0);
  EXPECT_EQ(last.count.submits, 3U);
  EXPECT_EQ(last.count.passes, 5U);
  EXPECT_EQ(last.count.nodes, 7U);
  EXPECT_EQ(last.count.drawCalls, 5U);
  EXPECT_EQ(last.error.unconvergedPx, 0U) << "that it was wrong is no more so";
}

TEST(Statistics, WhatIsShownAgainIsAsWrongAndCostsNothing) {
  const FrameStatistics before{.ms = {.total = 9, .gpu = 4},
                               .count = {.nodes = 7, .culledHidden = 3, .drawCalls = 6, .submits = 2},
                               .error = {.boundPx = 0.4, .residualMaxPx = 1e-4}};
  const FrameStatistics now = shownAgain(before);
  EXPECT_EQ(now.ms.total + now.ms.gpu, 0);
  EXPECT_EQ(now.count.nodes, 7U);
  EXPECT_EQ(now.count.culledHidden, 3U);
  EXPECT_EQ(now.count.drawCalls + now.count.submits, 0U);
  EXPECT_EQ(now.error.boundPx, 0.4);
  EXPECT_EQ(now.error.residualMaxPx, 1e-4);
}

}  // namespace
}  // namespace luxo
