// SPDX-License-Identifier: Apache-2.0
// Places in a pixel, and places spread evenly over a square.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
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

inline constexpr double kPlastic = 1.32471795724474602596;  ///< the plastic number, x^3 = x + 1

/// Point n of the additive recurrence with the plastic number, in the unit square (M. Roberts, The
/// unreasonable effectiveness of quasirandom sequences, 2018).
inline Vec2 quasirandomPoint(double n, const Vec2& shift = Vec2(0.5)) {
  const auto fraction = [](double a) { return a - std::floor(a); };
  return {fraction(shift.x + n / kPlastic), fraction(shift.y + n / (kPlastic * kPlastic))};
}

inline constexpr double kGoldenAngle = 2.399963229728653;  ///< pi (3 - sqrt 5)

/// Point k of n of the disc of radius 1, spread evenly: a spiral (H. Vogel, A better way to construct the
/// sunflower head, 1979).
inline Vec2 discPoint(std::uint32_t k, std::uint32_t n) {
  const double radius = std::sqrt((k + 0.5) / n), turn = kGoldenAngle * k;
  return radius * Vec2(std::cos(turn), std::sin(turn));
}

/// Point k of n of a luminous ball of radius 1 that looks like an evenly bright disc from everywhere afar.
///
/// For that all its projections onto planes must be uniform in the unit disc. Those of the uniform
/// distribution on the sphere S^3 in four dimensions are: dropping two coordinates of it leaves a uniform
/// disc, as dropping one of S^2 leaves a uniform interval (Archimedes' hat-box theorem in higher dimensions).
/// So one coordinate is dropped here, which leaves the density 1 / (pi^2 sqrt(1 - r^2)) in the ball, and the
/// way of the light drops the other. Uniform on S^3: K. Shoemake, Uniform random rotations, Graphics Gems
/// III, 1992. The numbers behind it are those of J. Hammersley, 1960, with quasirandomPoint(): spread evenly
/// for each n. Every other point is the one before it, mirrored at the middle, so that few points have their
/// mean there, too, and what they light is as bright. One point is the middle.
inline Vec3 luminousBallPoint(std::uint32_t k, std::uint32_t n) {
  if (n == 1) return Vec3(0);
  constexpr double kTurn = 6.283185307179586;
  const std::uint32_t pair = k / 2, pairs = (n + 1) / 2;
  const double part = (pair + 0.5) / pairs;
  const Vec2 turns = kTurn * quasirandomPoint(pair);
  const Vec3 point(std::sqrt(1 - part) * std::cos(turns.x), std::sqrt(1 - part) * std::sin(turns.x),
                   std::sqrt(part) * std::cos(turns.y));
  return k % 2 == 0 ? point : -point;
}

/// Point k of n in a cap of the unit sphere around +Z, `angle` from its middle to its rim, spread evenly over
/// its area: the spiral of discPoint(), whose heights are even by Archimedes' hat-box theorem. One point is
/// the middle.
inline Vec3 capPoint(std::uint32_t k, std::uint32_t n, double angle) {
  if (n == 1) return Vec3(0, 0, 1);
  const double half = std::sin(0.5 * angle), below = 2 * half * half * (k + 0.5) / n;  // 1 - cosine
  const double sine = std::sqrt(below * (2 - below)), turn = kGoldenAngle * k;
  return {sine * std::cos(turn), sine * std::sin(turn), 1 - below};
}

}  // namespace luxo
