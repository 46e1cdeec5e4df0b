// SPDX-License-Identifier: Apache-2.0
// Axes around a direction.
#pragma once

#include <array>
#include <cmath>

#include "math/vec.h"

namespace luxo {

/// Two unit vectors that complete `w`, unit, to a right-handed system (T. Duff et al., Building an
/// orthonormal basis, revisited, 2017).
inline std::array<Vec3, 2> completed(const Vec3& w) {
  const double sign = std::copysign(1.0, w.z);
  const double a = -1 / (sign + w.z), b = w.x * w.y * a;
  return {Vec3(1 + sign * w.x * w.x * a, sign * b, -sign * w.x), Vec3(b, sign + w.y * w.y * a, -w.y)};
}

}  // namespace luxo
