// SPDX-License-Identifier: Apache-2.0
#include "scene/normal_map.h"

#include <cmath>

namespace luxo {

NormalFrame normalFrame(const Vec3& su, const Vec3& sv, const Vec3& outward, bool turned) {
  const double length = glm::length(su);
  if (!(length > 0)) return NormalFrame(0);
  const double sign = turned ? -1 : 1;
  const double handed = glm::dot(glm::cross(su, sv), outward) < 0 ? -1 : 1;
  return NormalFrame(su * (sign / length), sign * handed);
}

Mat3 normalFromTexel(const Material& material, const Mat3& normalFromObject) {
  if (material.normalSpace == NormalSpace::Object) return normalFromObject;
  const TextureMap& map = material.normalMap;
  const double cosine = std::cos(map.angle), sine = std::sin(map.angle);
  const double right = map.scale.x < 0 ? -material.normalScale : material.normalScale,
               up = map.scale.y < 0 ? -material.normalScale : material.normalScale;
  return {right * cosine, up * sine, 0, -right * sine, up * cosine, 0, 0, 0, 1};
}

Vec3 bentNormal(const Material& material, const Mat3& normalFromTexel, const Vec3& texel, const Vec3& normal,
                const NormalFrame& frame) {
  const Vec3 v = normalFromTexel * (2.0 * texel - 1.0);
  const bool isObject = material.normalSpace == NormalSpace::Object;
  const Vec3 tangent(frame);
  const Vec3 bent = isObject ? v
                             : v.x * tangent + v.y * frame.w * glm::cross(normal, tangent) +
                                   v.z * std::abs(frame.w) * normal;
  const double length = glm::length(bent);
  if (!(length > 0) || !std::isfinite(length)) return normal;
  return (isObject && glm::dot(bent, normal) < 0 ? -bent : bent) / length;
}

}  // namespace luxo
