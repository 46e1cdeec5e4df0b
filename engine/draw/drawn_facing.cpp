// SPDX-License-Identifier: Apache-2.0
#include "draw/drawn_facing.h"

#include <algorithm>
#include <limits>

#include "cull/occlusion_buffer.h"
#include "draw/exact_data.h"

namespace luxo {

DrawnFacing::DrawnFacing(const View& view, const SnapshotNode& node, const Shell& shell)
    : shell_(shell),
      near_(view.perspective() ? view.near : -std::numeric_limits<double>::infinity()),
      corners_(inPicture(view, node, shell.positions)) {
  clips_ = std::ranges::any_of(corners_, [&](const Vec3& corner) {
    // What is moved may be moved over the edge.
    return !(corner.z > near_ && corner.x > kMovedPx && corner.x < view.size.width - kMovedPx &&
             corner.y > kMovedPx && corner.y < view.size.height - kMovedPx);
  });
}

bool DrawnFacing::uncertain(std::uint32_t firstIndex) const {
  const auto at = [&](std::uint32_t k) -> const Vec3& { return corners_[shell_.indices[firstIndex + k]]; };
  const PixelTriangle triangle{at(0), at(1), at(2)};
  return std::ranges::any_of(triangle, [&](const Vec3& corner) { return !(corner.z > near_); }) ||
         certainArea(triangle) == 0;
}

}  // namespace luxo
