// SPDX-License-Identifier: Apache-2.0
// What `--require-error` takes for enough, and what not.
#include "required_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace luxo {
namespace {

FrameReport frameOf(const FrameError& error) {
  FrameReport frame;
  frame.statistics.error = error;
  return frame;
}

std::string missOf(const FrameReport& frame, double mostPx) {
  const auto miss = requirementMiss(frame, mostPx);
  if (!miss) return "";
  EXPECT_FALSE(miss->hint.empty());
  return miss->what;
}

std::string missOf(const FrameError& error, double mostPx) { return missOf(frameOf(error), mostPx); }

TEST(RequiredError, MeshesByTheirBound) {
  EXPECT_EQ(missOf({.boundPx = 0.5}, 0.5), "");
  EXPECT_NE(missOf({.boundPx = 0.5}, 0.4999).find("0.5 px"), std::string::npos);
  EXPECT_NE(missOf({.boundPx = std::numeric_limits<double>::infinity()}, 1e300), "");
  EXPECT_NE(missOf({.boundPx = std::nan("")}, 1e300), "");
}

TEST(RequiredError, ExactPixelsByTheirResidual) {
  EXPECT_EQ(missOf({.residualMaxPx = 1e-4}, 1e-4), "");
  EXPECT_NE(missOf({.residualMaxPx = 1e-4}, 1e-9).find("residual is 0.0001 px"), std::string::npos);
  EXPECT_NE(missOf({.residualMaxPx = std::nan("")}, 1e300), "");
  // What is seen through is a mesh in the same picture.
  EXPECT_NE(missOf({.boundPx = 0.5, .residualMaxPx = 1e-4}, 0.01).find("proven error is 0.5 px"),
            std::string::npos);
}

TEST(RequiredError, ShowsDigitsThatDiffer) {
  EXPECT_EQ(missOf({.residualMaxPx = 1.00001e-5}, 1e-5),
            "the largest residual is 1.00001e-05 px, more than the 1e-05 px required");
  EXPECT_EQ(missOf({.boundPx = 0.5}, 0.1), "the proven error is 0.5 px, more than the 0.1 px required");
}

TEST(RequiredError, LostPixelsMissWhateverIsRequired) {
  EXPECT_NE(missOf({.residualMaxPx = 1e-4, .unconvergedPx = 1}, 1e300).find("1 pixels are lost"),
            std::string::npos);
  EXPECT_EQ(missOf({.residualMaxPx = 1e-4, .uncertifiedPx = 9}, 0.01), "") << "they lie on the surface";
}

TEST(RequiredError, TheReferenceByItsProofs) {
  FrameReport frame = frameOf({.boundPx = 0});
  frame.reference = ReferenceStatistics{.hits = 3};
  EXPECT_EQ(missOf(frame, 1e-300), "");
  frame.reference->undecided = 7;
  frame.statistics.error.boundPx = std::numeric_limits<double>::infinity();
  EXPECT_NE(missOf(frame, 1e300).find("7 pixels are undecided"), std::string::npos);
}

}  // namespace
}  // namespace luxo
