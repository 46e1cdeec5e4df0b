// SPDX-License-Identifier: Apache-2.0
// The cone of a spot light at one moment, and how much of its light goes which way: of a direction at the
// angle a from the axis
//
//     clamp((cos a - cos outer) / (cos inner - cos outer), 0, 1)^2,
//
// all within the inner cone, nothing beyond the outer one, smooth at both. It is what Khronos'
// KHR_lights_punctual (2018, "Inner and Outer Cone Angles") recommends, but for its least difference of two
// cosines, 0.001: here the angles are as they are given. Brightness on the axis does not depend on them.
// shaders/lib/illumination.glsl has the same in float.
#pragma once

#include "math/numbers.h"
#include "math/vec.h"

namespace luxo {

/// Half-angles, radians: 0 <= inner < outer, outer from kLeastSpotAngle to kMaxLightAngle (scene/ranges.h).
struct SpotCone {
  Vec3 axis{0, 0, -1};  ///< unit, world: the way that it shines
  double inner = 0, outer = kPi / 4;

  /// 1 - cos outer, and cos inner - cos outer, without what a difference of cosines loses of small angles.
  [[nodiscard]] double rise() const;
  [[nodiscard]] double penumbra() const;

  friend bool operator==(const SpotCone&, const SpotCone&) = default;
};

/// The part of the light that goes that way, 0 to 1. `fromLight`: of any length but 0. Error: as if the angle
/// were off by 1e-15 radians.
[[nodiscard]] double spotAttenuation(const SpotCone& cone, const Vec3& fromLight);

}  // namespace luxo
