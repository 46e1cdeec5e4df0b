// SPDX-License-Identifier: Apache-2.0
#include "slider_scale.h"

#include <gtest/gtest.h>

namespace luxo {
namespace {

Parameter parameter(double lo, double hi, std::optional<double> step = {}) {
  return {.name = "p", .value = lo, .range = Interval(lo, hi), .step = step};
}

TEST(SliderScale, EndsAreTheRange) {
  for (const auto& [lo, hi] : {std::pair(1.0, 12.0), {-0.3, 0.7}, {1e-9, 3e-9}, {-1e6, 5e8}}) {
    const Parameter p = parameter(lo, hi);
    EXPECT_EQ(sliderValue(p, 0), lo);
    EXPECT_EQ(sliderValue(p, 1), hi);
    EXPECT_EQ(sliderPosition(p, lo), 0);
    EXPECT_EQ(sliderPosition(p, hi), 1);
  }
}

TEST(SliderScale, StepsAreCountedFromTheLowerEnd) {
  const Parameter p = parameter(1, 12, 2);  // 1 3 5 7 9 11: 12 is no step
  EXPECT_EQ(sliderValue(p, 0), 1);
  EXPECT_EQ(sliderValue(p, 0.1), 3);  // 2.1
  EXPECT_EQ(sliderValue(p, 1), 11);
  EXPECT_EQ(sliderValue(parameter(0, 0.3, 0.1), 1), 0.3) << "although 0.3 / 0.1 is below 3";
}

TEST(SliderScale, ValuesAreShortDecimals) {
  // 0 to 6: a thousandth of the range is 0.006, so values are multiples of 0.001.
  EXPECT_EQ(sliderValue(parameter(0, 6), 0.2057), 1.234);
  EXPECT_EQ(sliderValue(parameter(0, 60000), 0.5000001), 30000);
  EXPECT_EQ(sliderText(1.234), "1.234");
  EXPECT_EQ(sliderText(30000), "30000");
}

TEST(SliderScale, PositionsAreClampedAndLinear) {
  const Parameter p = parameter(-1, 3);
  EXPECT_EQ(sliderPosition(p, 1), 0.5);
  EXPECT_EQ(sliderPosition(p, -7), 0);
  EXPECT_EQ(sliderPosition(p, 7), 1);
}

}  // namespace
}  // namespace luxo
