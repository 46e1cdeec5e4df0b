// SPDX-License-Identifier: Apache-2.0
#include "scene/lesson.h"

#include <algorithm>
#include <cmath>

#include "base/srgb_curve.h"

namespace luxo {
namespace {

constexpr double kFloor = 20.0 / 255, kDiffuse = 1.2, kReflected = 0.6, kInShadow = 0.3;

Vec3 encoded(const Vec3& linear) {
  return {srgbFromLinear(linear.x), srgbFromLinear(linear.y), srgbFromLinear(linear.z)};
}

Vec3 shown(const Vec3& code) {
  const Vec3 c = glm::min(code, Vec3(1));
  return {linearFromSrgb(c.x), linearFromSrgb(c.y), linearFromSrgb(c.z)};
}

}  // namespace

Vec3 LessonPoint::dark() const { return shown(kFloor + encoded(glow)); }

Vec3 LessonPoint::added(const Vec3& toLight, const Vec3& radiance, const Vec3& visible) const {
  const double cosine = glm::dot(normal, toLight);
  const double along = std::max(glm::dot(2 * cosine * normal - toLight, toEye), 0.0);
  const Vec3 part = kInShadow + (1 - kInShadow) * visible;
  const Vec3 light = encoded(color) * radiance * part *
                     (kDiffuse * std::max(cosine, 0.0) + kReflected * std::pow(along, exponent));
  return shown(kFloor + encoded(glow) + light) - dark();
}

}  // namespace luxo
