// SPDX-License-Identifier: Apache-2.0
#include "image/srgb.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <vector>

namespace luxo {
namespace {

// IEC 61966-2-1, written out again on its own: the definition the fast path must equal for every float.
int expectedCode(float linear) {
  const double c = std::isnan(linear) ? 0.0 : std::fmin(std::fmax(double(linear), 0.0), 1.0);
  const double s = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055;
  return int(std::floor(255.0 * s + 0.5));
}

void expectExact(std::uint32_t bits) {
  const auto linear = std::bit_cast<float>(bits);
  ASSERT_EQ(int(encodeSrgb8(linear)), expectedCode(linear)) << linear << " bits " << bits;
}

TEST(Srgb, KnownCodes) {
  EXPECT_EQ(encodeSrgb8(0.0f), 0);
  EXPECT_EQ(encodeSrgb8(1.0f), 255);
  EXPECT_EQ(encodeSrgb8(0.5f), 188);   // 255 * 0.735357 = 187.52
  EXPECT_EQ(encodeSrgb8(0.18f), 118);  // photographic middle grey: 255 * 0.461356 = 117.65
  EXPECT_EQ(encodeSrgb8(0.001f), 3);   // the straight part: 255 * 0.01292 = 3.29
  EXPECT_EQ(encodeSrgb8(0.025f), 44);  // 255 * 0.171882 = 43.83
}

TEST(Srgb, WhatIsNotAColourIsClamped) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(encodeSrgb8(-1.0f), 0);
  EXPECT_EQ(encodeSrgb8(-0.0f), 0);
  EXPECT_EQ(encodeSrgb8(-infinity), 0);
  EXPECT_EQ(encodeSrgb8(std::numeric_limits<float>::quiet_NaN()), 0);
  EXPECT_EQ(encodeSrgb8(-std::numeric_limits<float>::quiet_NaN()), 0);
  EXPECT_EQ(encodeSrgb8(std::numeric_limits<float>::denorm_min()), 0);
  EXPECT_EQ(encodeSrgb8(1.5f), 255);
  EXPECT_EQ(encodeSrgb8(infinity), 255);
}

TEST(Srgb, EqualsTheFormulaAroundEveryChangeOfCode) {
  for (int code = 1; code < 256; ++code) {
    const auto near = std::bit_cast<std::uint32_t>(float(linearFromSrgb((code - 0.5) / 255)));
    for (std::uint32_t bits = near - 2000; bits <= near + 2000; ++bits) expectExact(bits);
  }
}

TEST(Srgb, EqualsTheFormulaAllOverTheFloats) {
  // 4,000,037 is a prime: about a thousand floats of all kinds, NaN and negatives included.
  for (std::uint64_t bits = 0; bits < (std::uint64_t{1} << 32); bits += 4'000'037)
    expectExact(std::uint32_t(bits));
  // Every 11th float from 2^-14 to 2: more than 10^7 of those whose code is in question.
  const auto last = std::bit_cast<std::uint32_t>(2.0f);
  std::size_t count = 0;
  for (auto bits = std::bit_cast<std::uint32_t>(0x1p-14f); bits < last; bits += 11, ++count)
    expectExact(bits);
  EXPECT_GT(count, 10'000'000u);
}

TEST(Srgb, EveryCodeSurvivesDecodingAndEncoding) {
  for (int code = 0; code < 256; ++code) EXPECT_EQ(encodeSrgb8(decodeSrgb8(std::uint8_t(code))), code);
}

TEST(Srgb, CurvesAreInverse) {
  // The standard's two pieces meet only to 5e-8 (its constants are rounded), which bounds the mismatch near
  // the joint.
  for (int i = 0; i <= 1000; ++i) EXPECT_NEAR(linearFromSrgb(srgbFromLinear(i / 1000.0)), i / 1000.0, 1e-8);
  EXPECT_NEAR(srgbFromLinear(0.0031308), srgbFromLinear(std::nextafter(0.0031308, 1.0)), 5e-8);
}

TEST(Srgb, AlphaStaysLinear) {
  EXPECT_EQ(encodeAlpha8(0.5f), 128);  // 127.5 rounds up
  EXPECT_EQ(encodeAlpha8(std::numeric_limits<float>::quiet_NaN()), 0);
  EXPECT_EQ(encodeAlpha8(-3.0f), 0);
  EXPECT_EQ(encodeAlpha8(7.0f), 255);
  const std::vector<float> linear = {0.5f, 0.5f, 0.5f, 0.5f, 1.0f, 0.0f, 0.18f, 0.25f};
  std::vector<std::uint8_t> codes(linear.size());
  encodeSrgb8(linear, 4, codes);
  EXPECT_EQ(codes, (std::vector<std::uint8_t>{188, 188, 188, 128, 255, 0, 118, 64}));
}

TEST(Srgb, PixelsOfOneChannelBecomeGrey) {
  const std::vector<float> linear = {0.5f, 1.0f};
  std::vector<std::uint8_t> codes(6);
  encodePixels8(linear, 1, codes);
  EXPECT_EQ(codes, (std::vector<std::uint8_t>{188, 188, 188, 255, 255, 255}));
}

}  // namespace
}  // namespace luxo
