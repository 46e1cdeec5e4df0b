// SPDX-License-Identifier: Apache-2.0
// What a picture learns from the pixels it lost.
#include "draw/search_refinement.h"

#include <gtest/gtest.h>

namespace luxo {
namespace {

TEST(SearchRefinement, WithoutLossesThereIsNothingToLearn) {
  SearchRefinement refinement;
  EXPECT_FALSE(refinement.learn({}));
  EXPECT_FALSE(refinement.learn({.transversal = {0, 0}, .grazing = {{3, 0}}}));
  EXPECT_EQ(refinement.lost(), 0U);
  EXPECT_EQ(refinement.level(3), 0);
}

TEST(SearchRefinement, TransversalTrianglesThatLostPixelsStayGrazing) {
  SearchRefinement refinement;
  EXPECT_TRUE(refinement.learn({.transversal = {0, 2, 0, 1}, .grazing = {}}));
  EXPECT_EQ(refinement.lost(), 3U);
  EXPECT_FALSE(refinement.learn({.transversal = {0, 0, 0, 0}, .grazing = {{0, 0}}}));
  EXPECT_EQ(refinement.lost(), 0U) << "they were found";
  EXPECT_TRUE(refinement.lostTransversal(1));
  EXPECT_TRUE(refinement.lostTransversal(3));
  EXPECT_FALSE(refinement.lostTransversal(0));
  EXPECT_FALSE(refinement.lostTransversal(99));
}

TEST(SearchRefinement, ShellsGetFinerWhileThatHelps) {
  SearchRefinement refinement;
  EXPECT_TRUE(refinement.learn({.transversal = {}, .grazing = {{1, 0}, {4, 9}}}));
  EXPECT_EQ(refinement.level(4), 1);
  EXPECT_TRUE(refinement.refined(4));
  EXPECT_FALSE(refinement.refined(1));
  EXPECT_TRUE(refinement.learn({.transversal = {}, .grazing = {{4, 5}}}));
  EXPECT_EQ(refinement.level(4), 2);
  EXPECT_FALSE(refinement.learn({.transversal = {}, .grazing = {{4, 5}}})) << "a singular point";
  EXPECT_EQ(refinement.level(4), 2);
  EXPECT_FALSE(refinement.refined(4));
  EXPECT_EQ(refinement.lost(), 5U);
}

TEST(SearchRefinement, WhatIsNotDrawnAgainKeepsItsLosses) {
  SearchRefinement refinement;
  EXPECT_TRUE(refinement.learn({.transversal = {}, .grazing = {{0, 2}, {1, 8}}}));
  EXPECT_TRUE(refinement.learn({.transversal = {}, .grazing = {{0, 2}, {1, 3}}}));
  EXPECT_FALSE(refinement.refined(0)) << "that did not help";
  EXPECT_FALSE(refinement.learn({.transversal = {}, .grazing = {{1, 0}}}));
  EXPECT_EQ(refinement.lost(), 2U) << "those of node 0, which was not drawn again";
}

TEST(SearchRefinement, TheNextPictureKeepsWhatIsSeenFlat) {
  SearchRefinement refinement;
  EXPECT_TRUE(refinement.learn({.transversal = {0, 0, 0, 0, 1}, .grazing = {{0, 2}}}));
  refinement.completes = true;
  refinement.beginPicture();
  EXPECT_TRUE(refinement.lostTransversal(4));
  EXPECT_EQ(refinement.level(0), 0);
  EXPECT_FALSE(refinement.completes);
}

TEST(SearchRefinement, ForgetsViewsLongGone) {
  SearchRefinement refinement;
  const std::vector<std::uint32_t> mostly{1, 1, 0, 0}, few{0, 0, 0, 1};
  EXPECT_TRUE(refinement.learn({.transversal = mostly, .grazing = {}}));
  EXPECT_TRUE(refinement.learn({.transversal = few, .grazing = {}}));
  EXPECT_FALSE(refinement.lostTransversal(0));
  EXPECT_TRUE(refinement.lostTransversal(3));
}

}  // namespace
}  // namespace luxo
