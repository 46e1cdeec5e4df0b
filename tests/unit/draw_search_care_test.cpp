// SPDX-License-Identifier: Apache-2.0
// What a picture learns from the pixels it lost.
#include "draw/search_care.h"

#include <gtest/gtest.h>

namespace luxo {
namespace {

TEST(SearchCare, WithoutLossesThereIsNothingToLearn) {
  SearchCare care;
  EXPECT_FALSE(care.learn({}));
  EXPECT_FALSE(care.learn({.inFlat = {0, 0}, .inSteep = {{3, 0}}}));
  EXPECT_EQ(care.lost(), 0U);
  EXPECT_EQ(care.level(3), 0);
}

TEST(SearchCare, FlatTrianglesThatLostPixelsStaySteep) {
  SearchCare care;
  EXPECT_TRUE(care.learn({.inFlat = {0, 2, 0, 1}, .inSteep = {}}));
  EXPECT_EQ(care.lost(), 3U);
  EXPECT_FALSE(care.learn({.inFlat = {0, 0, 0, 0}, .inSteep = {{0, 0}}}));
  EXPECT_EQ(care.lost(), 0U) << "they were found";
  EXPECT_TRUE(care.lostInFlat(1));
  EXPECT_TRUE(care.lostInFlat(3));
  EXPECT_FALSE(care.lostInFlat(0));
  EXPECT_FALSE(care.lostInFlat(99));
}

TEST(SearchCare, HullsGetFinerWhileThatHelps) {
  SearchCare care;
  EXPECT_TRUE(care.learn({.inFlat = {}, .inSteep = {{1, 0}, {4, 9}}}));
  EXPECT_EQ(care.level(4), 1);
  EXPECT_TRUE(care.refined(4));
  EXPECT_FALSE(care.refined(1));
  EXPECT_TRUE(care.learn({.inFlat = {}, .inSteep = {{4, 5}}}));
  EXPECT_EQ(care.level(4), 2);
  EXPECT_FALSE(care.learn({.inFlat = {}, .inSteep = {{4, 5}}})) << "a singular point";
  EXPECT_EQ(care.level(4), 2);
  EXPECT_FALSE(care.refined(4));
  EXPECT_EQ(care.lost(), 5U);
}

TEST(SearchCare, WhatIsNotDrawnAgainKeepsItsLosses) {
  SearchCare care;
  EXPECT_TRUE(care.learn({.inFlat = {}, .inSteep = {{0, 2}, {1, 8}}}));
  EXPECT_TRUE(care.learn({.inFlat = {}, .inSteep = {{0, 2}, {1, 3}}}));
  EXPECT_FALSE(care.refined(0)) << "that did not help";
  EXPECT_FALSE(care.learn({.inFlat = {}, .inSteep = {{1, 0}}}));
  EXPECT_EQ(care.lost(), 2U) << "those of node 0, which was not drawn again";
}

TEST(SearchCare, TheNextPictureKeepsWhatIsSeenFlat) {
  SearchCare care;
  EXPECT_TRUE(care.learn({.inFlat = {0, 0, 0, 0, 1}, .inSteep = {{0, 2}}}));
  care.completes = true;
  care.beginPicture();
  EXPECT_TRUE(care.lostInFlat(4));
  EXPECT_EQ(care.level(0), 0);
  EXPECT_FALSE(care.completes);
}

TEST(SearchCare, ForgetsViewsLongGone) {
  SearchCare care;
  const std::vector<std::uint32_t> mostly{1, 1, 0, 0}, few{0, 0, 0, 1};
  EXPECT_TRUE(care.learn({.inFlat = mostly, .inSteep = {}}));
  EXPECT_TRUE(care.learn({.inFlat = few, .inSteep = {}}));
  EXPECT_FALSE(care.lostInFlat(0));
  EXPECT_TRUE(care.lostInFlat(3));
}

}  // namespace
}  // namespace luxo
