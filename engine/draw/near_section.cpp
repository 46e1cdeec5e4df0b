// SPDX-License-Identifier: Apache-2.0
#include "draw/near_section.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace luxo {
namespace {

/// Of the near plane's depth: as much as single precision may see it beside its place, thrice.
constexpr double kPlaneDepth = 0x1p-20;

/// A rectangle around places of the picture, pixels from its middle.
class Surround {
 public:
  void add(const Vec2& place) {
    low_ = glm::min(low_, place);
    high_ = glm::max(high_, place);
  }

  [[nodiscard]] PixelRect pixels(PixelSize size) const {
    const auto within = [](double x, int most) {
      return static_cast<std::int32_t>(std::clamp(x, 0.0, static_cast<double>(most)));
    };
    const Vec2 middle(0.5 * size.width, 0.5 * size.height);
    const Vec2 low = glm::floor(low_ + middle) - 1.0, high = glm::ceil(high_ + middle) + 1.0;
    const PixelPlace first{within(low.x, size.width), within(low.y, size.height)};
    // Nothing was added: high is below low.
    return {first,
            {std::max(first.x, within(high.x, size.width)), std::max(first.y, within(high.y, size.height))}};
  }

 private:
  Vec2 low_{std::numeric_limits<double>::infinity()}, high_{-std::numeric_limits<double>::infinity()};
};

}  // namespace

void appendNearSection(const View& view, const SnapshotNode& node, const Shell& shell,
                       const Shell::Part& part, std::vector<PixelRect>& rects) {
  const PixelRows rows = pixelRows(view, node.worldFromObject);
  const double slack = kPlaneDepth * std::max(view.near, -view.near);
  const auto inPicture = [&](const Vec3& corner) {
    return Vec2(corner) / (view.perspective() ? corner.z : 1.0);
  };
  std::array<Vec3, 6> corners;  // right, down and depth
  for (std::uint32_t i = 0; i < part.faceCount(); i += 3) {
    double nearest = std::numeric_limits<double>::infinity(), farthest = -nearest;
    for (std::uint32_t k = 0; k < 6; ++k) {
      const std::uint32_t face = k < 3 ? part.firstIndex : part.bottomIndex();
      const Vec4 corner(shell.positions[shell.indices[face + i + k % 3]], 1);
      corners[k] = {glm::dot(rows.x, corner), glm::dot(rows.y, corner), glm::dot(rows.depth, corner)};
      nearest = std::min(nearest, corners[k].z);
      farthest = std::max(farthest, corners[k].z);
    }
    if (!(nearest <= view.near + slack && farthest >= view.near - slack)) continue;
    // The prism is within the convex hull of its corners, and what that has within the slack of the plane
    // within the one of its corners there and of where its edges and diagonals cross.
    Surround section;
    for (const Vec3& corner : corners)
      if (std::abs(corner.z - view.near) <= slack) section.add(inPicture(corner));
    for (const double depth : {view.near - slack, view.near + slack})
      for (std::size_t a = 0; a < corners.size(); ++a)
        for (std::size_t b = 0; b < a; ++b) {
          const Vec3 &p = corners[a], &q = corners[b];
          if ((p.z < depth) != (q.z < depth))
            section.add(inPicture(p + (depth - p.z) / (q.z - p.z) * (q - p)));
        }
    const PixelRect pixels = section.pixels(view.size);
    if (pixels.count() > 0) rects.push_back(pixels);
  }
}

}  // namespace luxo
