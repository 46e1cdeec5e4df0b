// SPDX-License-Identifier: Apache-2.0
#include "draw/drawn_facing.h"

#include <array>
#include <cmath>
#include <utility>

#include "cull/raster_slack.h"
#include "draw/pixel_rows.h"
#include "shared/scene_data.h"

namespace luxo {

static_assert(kMovedPx == shared::kMovedPx);

namespace {

/// certainArea() of corners as PixelRows has them.
template <class Corners>
double areaOf(Corners polygon) {
  for (Vec3& corner : polygon) corner /= corner.z;
  return certainArea(polygon);
}

}  // namespace

DrawnFacing::DrawnFacing(const View& view, const SnapshotNode& node, const Shell& shell)
    : shell_(shell), size_(view.size), mirrored_(glm::determinant(node.worldFromObject.linear) < 0) {
  const PixelRows rows = pixelRows(view, node.worldFromObject);
  // What is moved may be moved over the edge.
  const Vec2 most = 0.5 * Vec2(size_.width, size_.height) - Vec2(kMovedPx);
  corners_.reserve(shell.positions.size());
  shows_.reserve(shell.positions.size());
  for (const Vec3& position : shell.positions) {
    const Vec4 p(position, 1);
    const double depth = glm::dot(rows.depth, p), width = view.perspective() ? depth : 1;
    const Vec3 corner(glm::dot(rows.x, p), glm::dot(rows.y, p), width);
    corners_.push_back(corner);
    shows_.push_back(width > 0 && depth > view.near && std::abs(corner.x) < most.x * width &&
                     std::abs(corner.y) < most.y * width);
    clips_ = clips_ || !shows_.back();
  }
}

DrawnFacing::Side DrawnFacing::side(std::uint32_t firstIndex) const {
  std::array<Vec3, 3> triangle;
  bool shows = true, inFront = true;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const std::uint32_t corner = shell_.indices[firstIndex + k];
    triangle[k] = corners_[corner];
    shows = shows && shows_[corner];
    inFront = inFront && corners_[corner].z > 0;
  }
  double area = 0;
  if (inFront) {
    area = areaOf(triangle);
    if (area == 0) return Side::Either;
  }
  if (!shows) {
    std::vector<Vec3> seen = clipped({triangle.begin(), triangle.end()}, size_);
    if (seen.empty()) return Side::Front;  // of nothing
    area = areaOf(std::move(seen));
    if (area == 0) return Side::Either;
  }
  // y leads down: counter-clockwise areas are below 0.
  return (area < 0) != mirrored_ ? Side::Front : Side::Back;
}

}  // namespace luxo
