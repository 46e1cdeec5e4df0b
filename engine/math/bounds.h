// SPDX-License-Identifier: Apache-2.0
// Bounding boxes and spheres in double; every operation is conservative: what was inside stays inside.
#pragma once

#include <array>
#include <limits>

#include "math/transform.h"

namespace luxo {

/// Axis-aligned box. The default holds nothing.
struct Box {
  Vec3 min{std::numeric_limits<double>::infinity()};
  Vec3 max{-std::numeric_limits<double>::infinity()};

  [[nodiscard]] bool empty() const { return !(min.x <= max.x && min.y <= max.y && min.z <= max.z); }
  [[nodiscard]] Vec3 center() const { return min + 0.5 * (max - min); }
  [[nodiscard]] Vec3 extent() const { return max - min; }
  [[nodiscard]] bool contains(const Vec3& p) const {
    return p.x >= min.x && p.x <= max.x && p.y >= min.y && p.y <= max.y && p.z >= min.z && p.z <= max.z;
  }
  void add(const Vec3& point) {
    min = glm::min(min, point);
    max = glm::max(max, point);
  }
  void add(const Box& other) {
    min = glm::min(min, other.min);
    max = glm::max(max, other.max);
  }
  friend bool operator==(const Box&, const Box&) = default;
};

/// Whether they have a point in common, or are no farther apart than that along each axis.
[[nodiscard]] inline bool overlap(const Box& a, const Box& b, double apart = 0) {
  return a.min.x <= b.max.x + apart && b.min.x <= a.max.x + apart && a.min.y <= b.max.y + apart &&
         b.min.y <= a.max.y + apart && a.min.z <= b.max.z + apart && b.min.z <= a.max.z + apart;
}

struct Sphere {
  Vec3 center{0};
  double radius = 0;
};

/// Smallest sphere around the box, rounded outward; of infinite radius around an infinite box.
[[nodiscard]] Sphere sphereAround(const Box& box);

[[nodiscard]] std::array<Vec3, 8> cornersOf(const Box& box);

/// Box around the transformed box (Arvo 1990), rounded outward.
[[nodiscard]] Box transformBounds(const Transform& t, const Box& box);

}  // namespace luxo
