// SPDX-License-Identifier: Apache-2.0
#include "image/srgb.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "base/assert.h"

namespace luxo {
namespace {

// Floats below 2^-13 encode to 0 (code 1 starts at 1.5e-4), and those from 1 on to 255. Between, the exponent
// and the top 7 bits of the mantissa select one of 13 * 128 buckets, each narrower than the distance of two
// code changes.
constexpr int kMantissaShift = 23 - 7;
constexpr std::uint32_t kFirstBits = std::uint32_t(127 - 13) << 23;
constexpr std::uint32_t kEndBits = std::uint32_t(127) << 23;
constexpr std::size_t kBuckets = (kEndBits - kFirstBits) >> kMantissaShift;

int codeInDouble(float linear) { return int(std::floor(255.0 * srgbFromLinear(linear) + 0.5)); }

struct Tables {
  std::array<float, 257> firstLinear;  ///< the smallest float with this code; [256] is never reached
  std::array<std::uint8_t, kBuckets> bucketCode;  ///< code of the smallest float in the bucket
  std::array<float, 256> linear;                  ///< of each code

  Tables() {
    firstLinear[0] = 0;
    firstLinear[256] = 2;
    for (int code = 1; code < 256; ++code) {
      float c = float(linearFromSrgb((code - 0.5) / 255));
      while (codeInDouble(c) >= code) c = std::nextafter(c, 0.0f);
      while (codeInDouble(c) < code) c = std::nextafter(c, 1.0f);
      firstLinear[std::size_t(code)] = c;
    }
    std::size_t code = 0;
    for (std::size_t bucket = 0; bucket < kBuckets; ++bucket) {
      const auto first = std::bit_cast<float>(kFirstBits + std::uint32_t(bucket << kMantissaShift));
      while (firstLinear[code + 1] <= first) ++code;
      bucketCode[bucket] = std::uint8_t(code);
    }
    for (std::size_t k = 0; k < 256; ++k) linear[k] = float(linearFromSrgb(double(k) / 255));
  }
};

const Tables& tables() {
  static const Tables instance;
  return instance;
}

std::uint8_t encode(const Tables& table, float linear) {
  constexpr auto kFirst = std::bit_cast<float>(kFirstBits);
  constexpr auto kLast = std::bit_cast<float>(kEndBits - 1);
  // Written so that NaN fails the first comparison and becomes 0.
  const float clamped = std::min(linear > kFirst ? linear : kFirst, kLast);
  const std::uint32_t bucket = (std::bit_cast<std::uint32_t>(clamped) - kFirstBits) >> kMantissaShift;
  const std::uint8_t code = table.bucketCode[bucket];
  return std::uint8_t(code + (clamped >= table.firstLinear[code + std::size_t{1}] ? 1 : 0));
}

}  // namespace

std::uint8_t encodeSrgb8(float linear) { return encode(tables(), linear); }

float decodeSrgb8(std::uint8_t code) { return tables().linear[code]; }

std::uint8_t encodeAlpha8(float alpha) {
  return std::uint8_t(255.0 * std::min(alpha > 0 ? double(alpha) : 0.0, 1.0) + 0.5);
}

void encodeSrgb8(std::span<const float> linear, int channels, std::span<std::uint8_t> codes) {
  LUXO_REQUIRE_COMPARE(linear.size(), ==, codes.size());
  const Tables& table = tables();
  if (channels != 4) {
    for (std::size_t i = 0; i < linear.size(); ++i) codes[i] = encode(table, linear[i]);
    return;
  }
  for (std::size_t i = 0; i + 3 < linear.size(); i += 4) {
    for (std::size_t c = i; c < i + 3; ++c) codes[c] = encode(table, linear[c]);
    codes[i + 3] = encodeAlpha8(linear[i + 3]);
  }
}

void encodePixels8(std::span<const float> row, int channels, std::span<std::uint8_t> codes) {
  if (channels != 1) return encodeSrgb8(row, channels, codes);
  LUXO_REQUIRE_COMPARE(row.size() * 3, ==, codes.size());
  const Tables& table = tables();
  for (std::size_t x = 0; x < row.size(); ++x) {
    const std::uint8_t code = encode(table, row[x]);
    codes[3 * x] = codes[3 * x + 1] = codes[3 * x + 2] = code;
  }
}

}  // namespace luxo
