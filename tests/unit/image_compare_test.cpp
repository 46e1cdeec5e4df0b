// SPDX-License-Identifier: Apache-2.0
#include "image/compare.h"

#include <cmath>
#include <limits>

#include "image/srgb.h"
#include "image_test_support.h"

namespace luxo {
namespace {

constexpr float kFloatInfinity = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

TEST(Compare, EqualImages) {
  const Image image = imageOfAnyBits(8, 8, 3, 1);
  const Comparison result = compare(image, image);
  EXPECT_EQ(result.max, 0);
  EXPECT_EQ(result.mean, 0);
  EXPECT_EQ(result.rmse, 0);
  EXPECT_EQ(result.psnr, double(kFloatInfinity));
  EXPECT_EQ(result.differingPixels8, 0);
  EXPECT_EQ(result.nanSamples, 0);
  EXPECT_EQ(result.pixels, 64);
}

TEST(Compare, NumbersByHand) {
  // Differences 0.25 and 0.5 in two of 2 * 2 * 3 samples.
  Image a(2, 2, 3), b(2, 2, 3);
  b.pixel(1, 0)[2] = 0.25f;
  b.pixel(0, 1)[0] = 0.5f;
  const Comparison result = compare(a, b);
  EXPECT_EQ(result.max, 0.5);
  EXPECT_EQ(result.maxX, 0);
  EXPECT_EQ(result.maxY, 1);
  EXPECT_DOUBLE_EQ(result.mean, 0.75 / 12);
  EXPECT_DOUBLE_EQ(result.rmse, std::sqrt(0.3125 / 12));
  EXPECT_DOUBLE_EQ(result.psnr, 10 * std::log10(12 / 0.3125));
  EXPECT_EQ(result.differingPixels8, 2);
}

TEST(Compare, FirstOfEqualMaximaIsReported) {
  Image a(3, 3, 1), b(3, 3, 1);
  b.pixel(2, 1)[0] = b.pixel(0, 2)[0] = 1;
  EXPECT_EQ(compare(a, b).maxX, 2);
  EXPECT_EQ(compare(a, b).maxY, 1);
}

TEST(Compare, SmallDifferencesMayShareAnEightBitCode) {
  const Image a(1, 1, 1, {0.5f}), b(1, 1, 1, {std::nextafter(0.5f, 1.0f)});
  EXPECT_EQ(compare(a, b).max, 0x1p-24);
  EXPECT_EQ(compare(a, b).differingPixels8, 0);
  EXPECT_EQ(compare(a, b, ComparisonSpace::Srgb8).max, 0);
}

// 0.0031308 and below the curve is 12.92 x; 0.5 is coded as 1.055 * 0.5^(1/2.4) - 0.055 = 0.735357.
TEST(Compare, SrgbCodesAreNotQuantised) {
  const Image a(1, 1, 4, {0.001f, 0.5f, 1, 0.25f}), b(1, 1, 4, {0.0011f, 0.5f, 7, 0.5f});
  const Comparison result = compare(a, b, ComparisonSpace::Srgb);
  EXPECT_EQ(result.max, 0.25) << "alpha, which has no curve";
  EXPECT_NEAR(result.mean * 4, 12.92e-4 + 0.25, 1e-9) << "above 1 all is white";
  const Image black(1, 1, 1, {0}), half(1, 1, 1, {0.5f});
  EXPECT_NEAR(compare(black, half, ComparisonSpace::Srgb).max, 0.735357, 1e-6);
}

TEST(Compare, SrgbCountsCodes) {
  const Image a(1, 1, 4, {decodeSrgb8(10), decodeSrgb8(20), 0, 100 / 255.0f});
  const Image b(1, 1, 4, {decodeSrgb8(13), decodeSrgb8(20), 0, 101 / 255.0f});
  const Comparison result = compare(a, b, ComparisonSpace::Srgb8);
  EXPECT_DOUBLE_EQ(result.max, 3 / 255.0);
  EXPECT_DOUBLE_EQ(result.mean, 4 / 255.0 / 4);
}

TEST(Compare, NaNAndInfinity) {
  const auto one = [](float a, float b, ComparisonSpace space = ComparisonSpace::Linear) {
    return compare(Image(1, 1, 1, {a}), Image(1, 1, 1, {b}), space);
  };
  EXPECT_EQ(one(kNaN, -kNaN).max, 0);
  EXPECT_EQ(one(kNaN, kNaN).nanSamples, 0);
  EXPECT_EQ(one(kNaN, 0).max, double(kFloatInfinity));
  EXPECT_EQ(one(kNaN, 0).nanSamples, 1);
  EXPECT_EQ(one(0, kNaN).mean, double(kFloatInfinity));
  EXPECT_EQ(one(kNaN, 0, ComparisonSpace::Srgb8).max, double(kFloatInfinity));
  EXPECT_EQ(one(kNaN, kFloatInfinity).max, double(kFloatInfinity));
  EXPECT_EQ(one(kFloatInfinity, kFloatInfinity).max, 0);
  EXPECT_EQ(one(kFloatInfinity, -kFloatInfinity).max, double(kFloatInfinity));
  EXPECT_EQ(one(kFloatInfinity, 3).max, double(kFloatInfinity));
  EXPECT_EQ(one(kFloatInfinity, 3).nanSamples, 0);
  EXPECT_EQ(one(kFloatInfinity, 3).psnr, -double(kFloatInfinity));
  EXPECT_EQ(one(0.0f, -0.0f).max, 0);
}

TEST(Compare, OtherShapesAreRefused) {
  for (const Image& other : {Image(3, 2, 3), Image(2, 3, 3), Image(2, 2, 4)}) {
    EXPECT_EQ(kindThrownBy([&] { static_cast<void>(compare(Image(2, 2, 3), other)); }),
              ErrorKind::Requirement);
    EXPECT_EQ(kindThrownBy([&] { static_cast<void>(heatMap(Image(2, 2, 3), other)); }),
              ErrorKind::Requirement);
  }
}

double luminance(std::span<const float> rgb) { return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]; }

TEST(HeatMap, BlackWhereEqualAndBrighterWhereMoreDiffers) {
  constexpr int kSteps = 200;
  const Image a(kSteps, 1, 3);
  Image b(kSteps, 1, 3);
  for (int x = 0; x < kSteps; ++x) b.pixel(x, 0)[1] = float(x) / kSteps;
  const Image map = heatMap(a, b);
  EXPECT_EQ(luminance(map.pixel(0, 0)), 0);
  for (int x = 1; x < kSteps; ++x) {
    EXPECT_GT(luminance(map.pixel(x, 0)), luminance(map.pixel(x - 1, 0))) << x;
    for (const float channel : map.pixel(x, 0)) {
      EXPECT_GE(channel, 0.0f) << x;
      EXPECT_LE(channel, 1.0f) << x;
    }
  }
  const auto least = map.pixel(1, 0), most = map.pixel(kSteps - 1, 0);
  EXPECT_GT(least[2], least[0]);  // violet: more blue than red, hardly any green
  EXPECT_GT(least[0], least[1]);
  EXPECT_GT(most[0], 3 * most[2]);  // yellow: red and green, hardly any blue
  EXPECT_GT(most[1], 3 * most[2]);
}

TEST(HeatMap, InfiniteDifferencesAreTheBrightestAndDoNotSetTheScale) {
  const Image a(3, 1, 1);
  const Image map = heatMap(a, Image(3, 1, 1, {0.01f, 0.02f, kNaN}));
  EXPECT_LT(luminance(map.pixel(0, 0)), luminance(map.pixel(1, 0)));
  EXPECT_EQ(luminance(map.pixel(1, 0)), luminance(map.pixel(2, 0)));
  const Image fixed = heatMap(a, Image(3, 1, 1, {0.01f, 0.02f, kNaN}), ComparisonSpace::Linear, 1.0);
  EXPECT_LT(luminance(fixed.pixel(1, 0)), luminance(fixed.pixel(2, 0)) / 2);
}

}  // namespace
}  // namespace luxo
