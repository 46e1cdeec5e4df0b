// SPDX-License-Identifier: Apache-2.0
// Half floats (IEEE 754 binary16): what textures hold.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace luxo {

/// The nearest half, ties to even; beyond 65504 infinity. Relative error 2^-11 from 2^-14 on, else 2^-25.
[[nodiscard]] inline std::uint16_t halfFromFloat(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  const auto sign = std::uint16_t(bits >> 16 & 0x8000);
  const float size = std::abs(value);
  if (std::isnan(value)) return sign | 0x7e00;
  if (size >= 65520.0f) return sign | 0x7c00;
  // Below 2^-14 halves are whole multiples of 2^-24, which adding 2^-1 rounds to.
  if (size < 0x1p-14f) return std::uint16_t(sign | (std::bit_cast<std::uint32_t>(size + 0.5f) & 0x7ff));
  // 13 bits of the mantissa go: half a unit is added, less at a tie with an even one.
  const std::uint32_t rounded = (bits & 0x7fffffff) + 0xfff + (bits >> 13 & 1);
  return std::uint16_t(sign | ((rounded >> 13) - ((127 - 15) << 10)));
}

/// Exact.
[[nodiscard]] inline float floatFromHalf(std::uint16_t half) {
  const int exponent = half >> 10 & 31, mantissa = half & 1023;
  const float size = exponent == 0    ? std::ldexp(float(mantissa), -24)
                     : exponent == 31 ? (mantissa != 0 ? std::numeric_limits<float>::quiet_NaN()
                                                       : std::numeric_limits<float>::infinity())
                                      : std::ldexp(float(1024 + mantissa), exponent - 25);
  return (half & 0x8000) != 0 ? -size : size;
}

}  // namespace luxo
