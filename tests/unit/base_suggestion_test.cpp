// SPDX-License-Identifier: Apache-2.0
#include "base/suggestion.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace luxo {
namespace {

TEST(Suggestion, FindsTheClosest) {
  const std::vector<std::string> names = {"--size", "--time", "--tolerance", "-o"};
  EXPECT_EQ(closestName("--sise", names), "--size");
  EXPECT_EQ(closestName("--SIZE", names), "--size");
  EXPECT_EQ(closestName("--tmie", names), "--time");  // two letters swapped are one slip
  EXPECT_EQ(closestName("--tolernce", names), "--tolerance");
  EXPECT_EQ(closestName("--tize", names), "--size");  // as close as --time: the first of equals
  EXPECT_EQ(closestName("--banana", names), "");
  EXPECT_EQ(didYouMean("--banana", names, "see help"), "see help");
}

TEST(Suggestion, OneLetterIsNotASlipAwayFromEveryOther) {
  const std::vector<std::string> names = {"u", "v", "pi"};
  EXPECT_EQ(closestName("w", names), "");
  EXPECT_EQ(closestName("U", names), "u");
  EXPECT_EQ(closestName("po", names), "pi");
  EXPECT_EQ(closestName("i", names), "");
}

}  // namespace
}  // namespace luxo
