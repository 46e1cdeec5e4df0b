// SPDX-License-Identifier: Apache-2.0
#include "cull/raster_slack.h"

#include <algorithm>
#include <cmath>

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

Frustum drawnFrustum(const View& view, bool lines) {
  const double samplePx = std::max(std::abs(view.sampleOffsetPx.x), std::abs(view.sampleOffsetPx.y));
  return frustumOf(view, kSnapPx + samplePx + (lines ? kLinePx : 0));
}

}  // namespace luxo
