// SPDX-License-Identifier: Apache-2.0
#include "shadow/shadow_reach.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "surface/spread.h"

namespace luxo {
namespace {

/// Of the numbers involved: what a dozen operations of double leave.
constexpr double kReachRounding = 1e-14;

/// The plane through the light with that normal: where the corners are, and how far off rounding may have
/// them.
struct BoxSides {
  double low = std::numeric_limits<double>::infinity(), high = -low, off = 0;

  BoxSides(const Vec4& light, const Vec3& normal, const std::array<Vec3, 8>& corners) {
    for (const Vec3& corner : corners) {
      const double along = glm::dot(normal, corner - light.w * Vec3(light));
      low = std::min(low, along);
      high = std::max(high, along);
      off = std::max(off, kReachRounding * (glm::dot(glm::abs(normal), glm::abs(corner)) +
                                            glm::dot(glm::abs(normal), glm::abs(light.w * Vec3(light)))));
    }
  }
};

}  // namespace

bool mayShadow(const Vec4& light, const Box& caster, const Box& receiver) {
  if (caster.empty() || receiver.empty()) return false;
  if (!isFinite(caster) || !isFinite(receiver)) return true;
  for (int k = 0; k < 3; ++k) {
    // A face with the light in front of it, or with rays that come toward it.
    const bool above = light.w != 0 ? light[k] > caster.max[k] : light[k] > 0,
               below = light.w != 0 ? light[k] < caster.min[k] : light[k] < 0;
    if ((above && receiver.min[k] > caster.max[k]) || (below && receiver.max[k] < caster.min[k]))
      return false;
    // Rays across this axis stay between its planes.
    if (light.w == 0 && light[k] == 0 && (receiver.min[k] > caster.max[k] || receiver.max[k] < caster.min[k]))
      return false;
  }
  const auto ofCaster = cornersOf(caster), ofReceiver = cornersOf(receiver);
  for (const auto* corners : {&ofCaster, &ofReceiver})
    for (const Vec3& corner : *corners)
      for (int k = 0; k < 3; ++k) {
        Vec3 edge(0);
        edge[k] = 1;
        // Through the edge and the light; of rays that are parallel through any point, as both boxes are held
        // against it.
        const Vec3 normal = glm::cross(edge, light.w != 0 ? corner - Vec3(light) : Vec3(light));
        const BoxSides casts(light, normal, ofCaster), receives(light, normal, ofReceiver);
        const double off = casts.off + receives.off;
        if (light.w == 0) {
          if (casts.low > receives.high + off || receives.low > casts.high + off) return false;
        } else if ((casts.low >= -casts.off && receives.high < -off) ||
                   (casts.high <= casts.off && receives.low > off)) {
          return false;
        }
      }
  return true;
}

}  // namespace luxo
