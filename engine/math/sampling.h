// SPDX-License-Identifier: Apache-2.0
// Places in a pixel, and places spread evenly over a square.
#pragma once

#include <array>
#include <cmath>
#include <span>

#include "math/vec.h"

namespace luxo {

/// Where Vulkan samples a pixel, once or four times, from its upper left corner (standardSampleLocations).
inline std::span<const Vec2> sampleLocations(int samples) {
  static constexpr std::array<Vec2, 1> kOne = {Vec2(0.5, 0.5)};
  static constexpr std::array<Vec2, 4> kFour = {Vec2(0.375, 0.125), Vec2(0.875, 0.375), Vec2(0.125, 0.625),
                                                Vec2(0.625, 0.875)};
  return samples == 4 ? std::span<const Vec2>(kFour) : std::span<const Vec2>(kOne);
}

/// Point n of the additive recurrence with the plastic number, in the unit square (M. Roberts, The
/// unreasonable effectiveness of quasirandom sequences, 2018).
inline Vec2 quasirandomPoint(double n, const Vec2& shift = Vec2(0.5)) {
  constexpr double kPlastic = 1.32471795724474602596;  // x^3 = x + 1
  const auto fraction = [](double a) { return a - std::floor(a); };
  return {fraction(shift.x + n / kPlastic), fraction(shift.y + n / (kPlastic * kPlastic))};
}

}  // namespace luxo
