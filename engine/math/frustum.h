// SPDX-License-Identifier: Apache-2.0
// The part of space a picture shows, as planes. Every test is conservative: "outside" and "inside" are
// proofs, "not outside" is not.
#pragma once

#include <array>

#include "math/bounds.h"
#include "math/transform.h"

namespace luxo {

/// Points with dot(normal, p) + offset >= 0 are inside. The normal is unit to rounding.
struct Plane {
  Vec3 normal{0};
  double offset = 0;

  friend bool operator==(const Plane&, const Plane&) = default;
};

/// World space: left, right, bottom, top, near. There is no far plane: depth is infinite, or fitted around
/// everything.
struct Frustum {
  std::array<Plane, 5> planes;
};

/// Whether one plane proves that nothing of the shape, grown by `slack` metres, is inside. Rounded outward by
/// gamma(16) of the magnitudes involved; a shape that is not finite is never outside.
[[nodiscard]] bool outside(const Frustum& frustum, const Sphere& sphere, double slack = 0);
[[nodiscard]] bool outside(const Frustum& frustum, const Transform& worldFromObject, const Box& boundsObject,
                           double slack = 0);

/// Whether all planes prove that all of the sphere, grown by `slack` metres, is inside. Rounded as above.
[[nodiscard]] bool inside(const Frustum& frustum, const Sphere& sphere, double slack = 0);

}  // namespace luxo
