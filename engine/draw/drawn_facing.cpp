// SPDX-License-Identifier: Apache-2.0
#include "draw/drawn_facing.h"

#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "cull/raster_slack.h"
#include "draw/pixel_rows.h"
#include "shared/scene_data.h"

namespace luxo {

static_assert(kMovedPx == shared::kMovedPx);

namespace {

/// Twice the area of a polygon, signed; nothing where it may turn over. As corners move by m along x and y
/// that changes by m times the lengths of its edges along both.
std::optional<double> areaOf(std::span<const Vec3> polygon) {
  double area = 0, change = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const Vec2 a = Vec2(p) / p.z, b = Vec2(q) / q.z;
    area += a.x * b.y - a.y * b.x;
    change += kMovedPx * (std::abs(b.x - a.x) + std::abs(b.y - a.y));
  }
  return std::abs(area) > change ? std::optional(area) : std::nullopt;
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
  std::optional<double> area;
  if (inFront) {
    area = areaOf(triangle);
    if (!area) return Side::Either;
  }
  if (!shows) {
    const std::vector<Vec3> seen = clipped({triangle.begin(), triangle.end()}, size_);
    if (seen.empty()) return Side::Front;  // of nothing
    area = areaOf(seen);
    if (!area) return Side::Either;
  }
  // y leads down: counter-clockwise areas are below 0.
  return (*area < 0) != mirrored_ ? Side::Front : Side::Back;
}

}  // namespace luxo
