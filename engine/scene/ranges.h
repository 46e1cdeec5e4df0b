// SPDX-License-Identifier: Apache-2.0
// What the numbers of scenes and of command lines may be, ends included: one limit each, wherever a number
// comes from.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "math/interval.h"
#include "math/vec.h"

namespace luxo {

/// The longest side of a picture in pixels: what images of every driver that luxo was tried on hold, and the
/// least that Vulkan's roadmap of 2022 asks for is half of it.
inline constexpr int kMaxPictureSide = 16384;

/// The most samples per pixel that anything takes.
inline constexpr int kMaxSamples = 256;

/// The largest number of a scene that devices compute with in float: lengths in metres, factors of light. Its
/// square, and three hundred of these together, are still within float's range, 3.4e38.
inline constexpr double kMaxSceneNumber = 1e18;

/// The largest light, color * intensity, in a scene whose colours are at most 1: it falls with the square of
/// a distance, of which 1e12 is one in this scale.
inline constexpr double kMaxLight = 1e30;
/// The largest product of a light and a colour: three hundred together are still within float's range.
inline constexpr double kMaxReflected = 1e36;

/// The largest half-angle of a directional light's disc, radians: a quarter turn, when it fills half the sky.
inline constexpr double kMaxLightAngle = 1.5707963267948966;
/// The least half-angle of a spot's outer cone, radians: its square is still within float's range, and so is
/// the quotient by the next smaller inner one, 1e34.
inline constexpr double kLeastSpotAngle = 1e-9;

/// Pixels. The least is a thousandth of what float positions in the largest picture can say, 2^-10; the most
/// is sixty of the largest pictures.
inline constexpr Interval kToleranceRange{1e-6, 1e6};

/// Frames per second, from one in eleven days: frame 2^31 is still at a time that is exact to a second.
inline constexpr Interval kFpsRange{1e-6, 1e6};

/// Whether each component is a factor of light that pixels can be computed with: from 0 to `most`.
[[nodiscard]] inline bool isColor(const Vec3& color, double most = kMaxSceneNumber) {
  const Interval range{0, most};
  return range.contains(color.x) && range.contains(color.y) && range.contains(color.z);
}

/// What formulas of u and v give as a colour: a component that is not a positive finite number is 0.
[[nodiscard]] inline Vec3 colorOrBlack(const Vec3& color) {
  const auto one = [](double c) { return c > 0 && std::isfinite(c) ? std::min(c, kMaxSceneNumber) : 0; };
  return {one(color.x), one(color.y), one(color.z)};
}

/// What a formula gives at a moment, cut off at `most`. 1 where something was cut off; what is not
/// finite is left as it is, for whoever knows what to call it.
[[nodiscard]] inline std::uint32_t cutToRange(double& value, double most = kMaxSceneNumber) {
  if (!(value > most && value <= std::numeric_limits<double>::max())) return 0;
  value = most;
  return 1;
}
[[nodiscard]] inline std::uint32_t cutToRange(Vec3& color, double most = kMaxSceneNumber) {
  return cutToRange(color.x, most) + cutToRange(color.y, most) + cutToRange(color.z, most);
}

}  // namespace luxo
