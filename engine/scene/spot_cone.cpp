// SPDX-License-Identifier: Apache-2.0
#include "scene/spot_cone.h"

#include <algorithm>
#include <cmath>

namespace luxo {

// 1 - cos a = 2 sin^2(a / 2), and cos a - cos b = 2 sin((a + b) / 2) sin((b - a) / 2).

double SpotCone::rise() const {
  const double sine = std::sin(0.5 * outer);
  return 2 * sine * sine;
}

double SpotCone::penumbra() const {
  return 2 * std::sin(0.5 * (outer + inner)) * std::sin(0.5 * (outer - inner));
}

double spotAttenuation(const SpotCone& cone, const Vec3& fromLight) {
  const Vec3 off = unit(fromLight) - cone.axis;
  const double part = std::clamp((cone.rise() - 0.5 * glm::dot(off, off)) / cone.penumbra(), 0.0, 1.0);
  return part * part;
}

}  // namespace luxo
