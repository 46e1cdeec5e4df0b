// SPDX-License-Identifier: Apache-2.0
// What interval arithmetic alone proves about a ray and a surface: no derivatives, no Newton, no tree,
// nothing of engine/reference. Slow, and often it cannot tell; what it says is so.
#pragma once

#include <optional>

#include "math/transform.h"
#include "surface/surface.h"

namespace luxo::test {

struct BruteForce {
  /// No point of the surface lies on the ray nearer than this, in metres along it; +infinity: none at all (of
  /// those between `nearest` and `farthest`).
  double clearUntil = 0;
  /// A point of the surface lies on the ray, surely, at `nearest` or beyond and not farther than this.
  std::optional<double> metBefore;
};

/// Parameter rectangles are cut in four until the surface's box over each passes by the ray, or it is 2^-13
/// of the patch, or there are 2,000. That a rectangle holds a point of the ray is proven by the signs on its
/// border (C. Miranda 1940). `direction` is unit. What is within 1e-13 of the distances involved of the ray
/// counts as on it for `clearUntil`, and as beside it for `metBefore`. Cost: milliseconds.
[[nodiscard]] BruteForce bruteForce(const Surface& surface, std::span<const double> parameters,
                                    const Transform& worldFromObject, const Vec3& origin,
                                    const Vec3& direction, double nearest, double farthest);

}  // namespace luxo::test
