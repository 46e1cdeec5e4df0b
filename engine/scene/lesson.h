// SPDX-License-Identifier: Apache-2.0
// The pixel of a well known lesson in software rendering (D. Sokolov, tinyrenderer, "Shadow mapping", 2015),
// in bytes of the picture:
//
//     min(20 + c * shadow * (1.2 * max(n.l, 0) + 0.6 * max(r.z, 0)^e), 255),  shadow = 0.3 or 1,
//
// where c is the colour map's byte, n a map's normal, r = 2 (n.l) n - l the light reflected in it, z the
// camera's axis, toward the eye, and e the byte of another map. No light is gated by a horizon.
// shaders/lib/lesson.glsl does the same in float.
//
// A picture here is linear light, written with the sRGB curve: with one white light of intensity 1, and no
// glow, its bytes are the lesson's. What the lesson leaves open: glow is added to the 20; a light's radiance
// is a factor of c; of several lights each adds, linearly, what it changes alone.
#pragma once

#include "math/vec.h"

namespace luxo {

/// Of a point: colours are linear, as maps and pictures have them.
struct LessonPoint {
  Vec3 color, glow;
  Vec3 normal;      ///< unit
  double exponent;  ///< of what is reflected
  Vec3 toEye;       ///< unit, along the camera's axis

  /// Linear, without any light.
  [[nodiscard]] Vec3 dark() const;
  /// What a light adds to that, linear. `toLight`: unit; `radiance`: what arrives there; `visible`: the part
  /// of it that no shadow takes, 0 to 1.
  [[nodiscard]] Vec3 added(const Vec3& toLight, const Vec3& radiance, const Vec3& visible) const;
};

}  // namespace luxo
