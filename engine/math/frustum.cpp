// SPDX-License-Identifier: Apache-2.0
#include "math/frustum.h"

#include <algorithm>
#include <cmath>

#include "math/rounding.h"

namespace luxo {

namespace {

/// Upper bound of dot(normal, p) + offset over the transformed box: the support of a box along a plane's
/// normal.
double farthestInside(const Plane& plane, const Transform& worldFromObject, const Box& box) {
  const Mat3& a = worldFromObject.linear;
  const Vec3 half = 0.5 * box.extent();
  const Vec3 center = transformPoint(worldFromObject, box.center());
  const double reach = std::abs(glm::dot(plane.normal, a[0])) * half.x +
                       std::abs(glm::dot(plane.normal, a[1])) * half.y +
                       std::abs(glm::dot(plane.normal, a[2])) * half.z;
  const Vec3 n = glm::abs(plane.normal);
  const double magnitude =
      glm::dot(n, glm::abs(worldFromObject.translation)) + std::abs(plane.offset) +
      glm::dot(n, Mat3(glm::abs(a[0]), glm::abs(a[1]), glm::abs(a[2])) * (glm::abs(box.center()) + half));
  return glm::dot(plane.normal, center) + plane.offset + reach + roundingGamma(16) * magnitude;
}

/// Of a sphere's middle from a plane, positive inside; and how far the sphere reaches, rounding and `slack`
/// included.
struct Reach {
  double distance, radius;
};

Reach reachOf(const Plane& plane, const Sphere& sphere, double slack) {
  const double magnitude =
      glm::dot(glm::abs(plane.normal), glm::abs(sphere.center)) + std::abs(plane.offset) + sphere.radius;
  return {glm::dot(plane.normal, sphere.center) + plane.offset,
          sphere.radius + slack + roundingGamma(16) * magnitude};
}

}  // namespace

bool outside(const Frustum& frustum, const Sphere& sphere, double slack) {
  return std::ranges::any_of(frustum.planes, [&](const Plane& plane) {
    const auto [distance, radius] = reachOf(plane, sphere, slack);
    return distance + radius < 0;
  });
}

bool inside(const Frustum& frustum, const Sphere& sphere, double slack) {
  return std::ranges::all_of(frustum.planes, [&](const Plane& plane) {
    const auto [distance, radius] = reachOf(plane, sphere, slack);
    return distance > radius;
  });
}

bool outside(const Frustum& frustum, const Transform& worldFromObject, const Box& boundsObject,
             double slack) {
  for (const Plane& plane : frustum.planes)
    if (farthestInside(plane, worldFromObject, boundsObject) + slack < 0) return true;
  return false;
}

}  // namespace luxo
