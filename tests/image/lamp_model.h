// SPDX-License-Identifier: Apache-2.0
// The moving parts of Luxo Grandpa by forward kinematics, and the spot its light makes on the floor, in
// closed form: written from the lamp's numbers alone, not from the engine.
#pragma once

#include <cmath>

#include "math/vec.h"

namespace luxo::test {

struct LampPose {
  Vec3 joint2{0}, joint3{0};
  Vec3 vertex{0}, focus{0}, axis{0};  ///< of the shade; axis toward its opening
};

inline constexpr double kFocalLength = 0.2, kShadeHeight = 1.8;
/// The rim is as far from the focus as from the directrix: h + f away, h - f along the axis.
inline constexpr double kCosRim = (kShadeHeight - kFocalLength) / (kShadeHeight + kFocalLength);

/// v turned about an axis of any length (Rodrigues).
inline Vec3 turned(const Vec3& v, const Vec3& axis, double angle) {
  const Vec3 d = glm::normalize(axis);
  return v * std::cos(angle) + d * glm::dot(d, v) * (1 - std::cos(angle)) +
         glm::cross(d, v) * std::sin(angle);
}

inline LampPose lampPose(double t) {
  // What hangs on joint n turns first about that joint's own axis, then about those below it.
  const auto up = [t](int joints) {
    Vec3 v(0, 1, 0);
    if (joints >= 3) v = turned(v, {2, 1, 2}, 1.0 * t);
    if (joints >= 2) v = turned(v, {2, 6, -1}, 0.75 * t);
    return turned(v, {1, 5, 1}, 0.5 * t);
  };
  LampPose pose;
  pose.joint2 = Vec3(0, 0.4, 0) + 4.0 * up(1);
  pose.joint3 = pose.joint2 + 4.0 * up(2);
  pose.axis = up(3);
  pose.vertex = pose.joint3 + 0.3 * pose.axis;
  pose.focus = pose.vertex + kFocalLength * pose.axis;
  return pose;
}

/// The lit part of the floor when all of the rim's cone reaches it.
struct Spot {
  Vec2 center{0}, direction{1, 0};  ///< (x, z); unit, along the longer half axis
  double longHalf = 0, shortHalf = 0;

  [[nodiscard]] bool holds(const Vec2& floor) const {
    const Vec2 q = floor - center;
    const double along = glm::dot(q, direction) / longHalf;
    const double across = (q.x * -direction.y + q.y * direction.x) / shortHalf;
    return along * along + across * across <= 1;
  }
  [[nodiscard]] Vec3 border(double angle) const {
    const Vec2 across(-direction.y, direction.x);
    const Vec2 q = center + longHalf * std::cos(angle) * direction + shortHalf * std::sin(angle) * across;
    return {q.x, 0, q.y};
  }
};

/// A cone of half angle theta whose axis leaves the vertical by delta meets the floor in an ellipse, if
/// theta + delta < 90 degrees.
inline Spot spotOf(const LampPose& pose) {
  const double theta = std::acos(kCosRim), delta = std::acos(-pose.axis.y), height = pose.focus.y;
  const double far = height * std::tan(delta + theta), near = height * std::tan(delta - theta);
  Spot spot;
  spot.direction = glm::normalize(Vec2(pose.axis.x, pose.axis.z));
  spot.center = Vec2(pose.focus.x, pose.focus.z) + (far + near) / 2 * spot.direction;
  spot.longHalf = (far - near) / 2;
  spot.shortHalf = height * std::sin(theta) /
                   std::sqrt(std::cos(delta) * std::cos(delta) - std::sin(theta) * std::sin(theta));
  return spot;
}

}  // namespace luxo::test
