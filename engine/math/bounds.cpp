// SPDX-License-Identifier: Apache-2.0
#include "math/bounds.h"

#include "math/rounding.h"

namespace luxo {

Sphere sphereAround(const Box& box) {
  if (box.empty()) return {};
  return {box.center(), 0.5 * glm::length(box.extent()) * (1 + 1e-15)};
}

Box transformBounds(const Transform& t, const Box& box) {
  if (box.empty()) return {};
  const Vec3 center = transformPoint(t, box.center());
  const Vec3 half = 0.5 * box.extent();
  const Mat3& a = t.linear;
  const Vec3 reach(glm::dot(Vec3(glm::abs(a[0].x), glm::abs(a[1].x), glm::abs(a[2].x)), half),
                   glm::dot(Vec3(glm::abs(a[0].y), glm::abs(a[1].y), glm::abs(a[2].y)), half),
                   glm::dot(Vec3(glm::abs(a[0].z), glm::abs(a[1].z), glm::abs(a[2].z)), half));
  const Vec3 margin = roundingGamma(8) * (glm::abs(center) + reach);
  return {center - reach - margin, center + reach + margin};
}

}  // namespace luxo
