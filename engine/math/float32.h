// SPDX-License-Identifier: Apache-2.0
// What is left of a double in single precision.
#pragma once

#include "math/vec.h"

namespace luxo {

/// The nearest float. Not the same as Vec3(Vec3f(v)): g++ 12 optimises two or more such conversions side by
/// side away (-O2, its vectoriser for straight-line code), which a volatile forbids.
[[nodiscard]] inline double roundedToFloat(double x) {
  const volatile float rounded = static_cast<float>(x);
  return rounded;
}
[[nodiscard]] inline Vec2 roundedToFloat(const Vec2& v) { return {roundedToFloat(v.x), roundedToFloat(v.y)}; }
[[nodiscard]] inline Vec3 roundedToFloat(const Vec3& v) {
  return {roundedToFloat(v.x), roundedToFloat(v.y), roundedToFloat(v.z)};
}

}  // namespace luxo
