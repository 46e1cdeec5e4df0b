// SPDX-License-Identifier: Apache-2.0
// What the pixels of a picture tell by values that are no numbers.
#include "draw/measured_pixels.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <vector>

namespace luxo {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity(), kMax = std::numeric_limits<float>::max(),
                kNan = std::numeric_limits<float>::quiet_NaN();

MeasuredPixels measured(const std::vector<std::array<float, 4>>& row) {
  MeasuredPixels result;
  addColors(std::as_bytes(std::span(row)).data(), static_cast<int>(row.size()), result);
  return result;
}

TEST(MeasuredPixels, NumbersTellNothing) {
  const MeasuredPixels row = measured({{0, 1, -1, 1}, {1e38F, -1e38F, 1e-40F, 0}});
  EXPECT_EQ(row.nonfinite, 0u);
  EXPECT_EQ(row.faults.endless + row.faults.seenThrough + row.faults.moved + row.faults.manyTraces, 0u);
}

/// Devices whose blending knows no infinity make the largest number of it.
TEST(MeasuredPixels, InfinitiesTellWhatAShaderDid) {
  for (const float most : {kInf, kMax}) {
    const MeasuredPixels row = measured({{most, most, most, 0},
                                         {0.5, 0.5, 0.5, 0},
                                         {-most, -most, -most, 0},
                                         {most, -most, most, 0},
                                         {most, -most, -most, 0},
                                         {most, -most, -most, 0}});
    EXPECT_EQ(row.nonfinite, 5u);
    EXPECT_EQ(row.faults.endless, 1u);
    EXPECT_EQ(row.faults.seenThrough, 1u);
    EXPECT_EQ(row.faults.moved, 1u);
    EXPECT_EQ(row.faults.manyTraces, 2u);
  }
}

TEST(MeasuredPixels, OtherValuesThatAreNoNumbersAreCountedOnly) {
  const MeasuredPixels row = measured({{kNan, kNan, kNan, 0}, {0, kInf, 0, 0}, {kInf, kNan, kInf, 0}});
  EXPECT_EQ(row.nonfinite, 3u);
  EXPECT_EQ(row.faults.endless + row.faults.seenThrough + row.faults.moved + row.faults.manyTraces, 0u);
}

TEST(MeasuredPixels, NobodyOverlooksThem) {
  std::vector<float> row{0.5, 0.5, 0.5, kMax, 0, 0, 0, kNan, 0, 0, 0, -kInf};
  showInMagenta(row);
  EXPECT_EQ(row, (std::vector<float>{0.5, 0.5, 0.5, 1, 0, 1, 1, 0, 1, 1, 0, 1}));
}

}  // namespace
}  // namespace luxo
