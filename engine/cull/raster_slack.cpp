// SPDX-License-Identifier: Apache-2.0
#include "cull/raster_slack.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "math/rounding.h"

namespace luxo {

double vertexSlack(const View& view, const SnapshotNode& node) {
  const Box& box = node.boundsObject;
  const Transform place = eyeFromObject(view, node.worldFromObject);
  const Vec3 reach = glm::max(glm::abs(box.min), glm::abs(box.max));
  const double size = glm::length(place.linear[0]) * reach.x + glm::length(place.linear[1]) * reach.y +
                      glm::length(place.linear[2]) * reach.z;
  return kVertexSlack * (glm::length(place.translation) + size) +
         roundingGamma(16) * (glm::length(view.eye) + glm::length(node.worldFromObject.translation));
}

// Twice the area of corners p_i is the sum of p_i x p_(i+1), where a x b = a.x b.y - a.y b.x. As they move by
// d_i, of at most m along x and y, it grows by the sum of
//   d_i x (p_(i+1) - p_(i-1)), each at most m (|x| + |y|) of that difference, and of
//   d_i x d_(i+1), twice the area of the corners d_i: of n - 2 triangles around d_0 in a square of side 2 m,
//   none of which is more than half of it, so at most 4 (n - 2) m^2.
double certainArea(std::span<const Vec3> corners) {
  const std::size_t n = corners.size();
  if (n < 3) return 0;
  double area = 0, reach = 4 * static_cast<double>(n - 2) * kMovedPx;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 before(corners[i == 0 ? n - 1 : i - 1]), after(corners[i + 1 == n ? 0 : i + 1]);
    const Vec2 at = Vec2(corners[i]) - Vec2(corners[0]), across = after - before;
    area += 0.5 * (at.x * across.y - at.y * across.x);  // each p_i x p_(i+1) is here twice
    reach += std::abs(across.x) + std::abs(across.y);
  }
  return std::abs(area) > kMovedPx * reach ? area : 0;
}

Frustum drawnFrustum(const View& view, bool lines) {
  const double samplePx = std::max(std::abs(view.sampleOffsetPx.x), std::abs(view.sampleOffsetPx.y));
  return frustumOf(view, kSnapPx + samplePx + (lines ? kLinePx : 0));
}

}  // namespace luxo
