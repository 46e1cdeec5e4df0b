// SPDX-License-Identifier: Apache-2.0
#include "cull/occluder_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cull/raster_slack.h"

namespace luxo {
namespace {

/// Pixels along a square, in pictures of up to kMaxSquares squares along them; in others more. Disks lose
/// about as much at their rims; larger ones cost less.
constexpr int kLeastSquare = 2, kMaxSquares = 1024;

/// Pixels: all samples of a pixel are within it, or, of a pass of many, half a pixel beside that
/// (View::sampleOffsetPx); and devices move corners of triangles.
constexpr double kBesidePx = 0.5 + kSnapPx;

}  // namespace

OccluderGrid::OccluderGrid(const View& view)
    : view_(view),
      square_(std::max(kLeastSquare,
                       (std::max(view.size.width, view.size.height) + kMaxSquares - 1) / kMaxSquares)),
      columns_((view.size.width + square_ - 1) / square_),
      rows_((view.size.height + square_ - 1) / square_) {}

/// A ball that is seen at an angle t from the axis and covers the angles up to a around it is an ellipse
/// along tan(t - a) to tan(t + a), which no other diameter of it is longer than.
OccluderGrid::Circle OccluderGrid::around(const Sphere& ball) const {
  const double depth = -ball.center.z, beside = glm::length(Vec2(ball.center)), f = view_.pixelsPerUnit;
  const Vec2 middle(0.5 * view_.size.width, 0.5 * view_.size.height);
  const auto inPicture = [&](double distance) {
    const Vec2 way = beside > 0 ? Vec2(ball.center.x, -ball.center.y) / beside : Vec2(0);
    return middle + f * distance * way;
  };
  if (!view_.perspective()) return {inPicture(beside), f * ball.radius};
  const double t = beside / depth,
               a = ball.radius / std::sqrt(depth * depth + beside * beside - ball.radius * ball.radius);
  if (!(t * a < 1)) return {middle, std::numeric_limits<double>::infinity()};
  const double low = (t - a) / (1 + t * a), high = (t + a) / (1 - t * a);
  return {inPicture(0.5 * (low + high)), 0.5 * f * (high - low)};
}

OccluderGrid::Run OccluderGrid::rowsOf(const Circle& circle) const {
  const auto rowAt = [&](double y) { return static_cast<int>(std::clamp(y / square_, 0.0, rows_ - 1.0)); };
  return {rowAt(circle.middle.y - circle.radius), rowAt(circle.middle.y + circle.radius) + 1};
}

OccluderGrid::Run OccluderGrid::within(const Circle& circle, int row) const {
  const double top = row * square_ - circle.middle.y, bottom = top + square_,
               left = circle.radius * circle.radius - std::max(top * top, bottom * bottom);
  if (!(left > 0)) return {};
  const double half = std::sqrt(left);
  const auto columnAt = [&](double x) { return static_cast<int>(std::clamp(x, 0.0, 1.0 * columns_)); };
  return {columnAt(std::ceil((circle.middle.x - half) / square_)),
          columnAt(std::floor((circle.middle.x + half) / square_))};
}

OccluderGrid::Run OccluderGrid::reached(const Circle& circle, int row) const {
  const double top = row * square_ - circle.middle.y,
               apart = std::max({top, -top - square_, 0.0});  // of the row and the circle's middle
  const double left = circle.radius * circle.radius - apart * apart;
  if (!(left >= 0)) return {};
  const double half = std::sqrt(left);
  const auto columnAt = [&](double x) { return static_cast<int>(std::clamp(x, 0.0, columns_ - 1.0)); };
  return {columnAt((circle.middle.x - half) / square_), columnAt((circle.middle.x + half) / square_) + 1};
}

void OccluderGrid::cover(const Sphere& ball, double slack) {
  const Vec3 center = eyeFromWorldPoint(view_, ball.center);
  const double depth = -center.z;
  if (!(depth > view_.near) || !(ball.radius > slack)) return;
  const double perMetre = view_.pixelsPerUnit / (view_.perspective() ? depth : 1);
  const Circle disk{pixelFromEye(view_, center), perMetre * (ball.radius - slack) - kBesidePx};
  if (!(disk.radius > 0) || !std::isfinite(glm::length(disk.middle))) return;
  if (farthest_.empty())
    farthest_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_),
                     std::numeric_limits<float>::infinity());
  // Rounded up: nothing before the disk is behind it.
  const float far = std::nextafter(static_cast<float>(depth), std::numeric_limits<float>::infinity());
  const Run rows = rowsOf(disk);
  for (int row = rows.first; row < rows.end; ++row) {
    const auto [first, end] = within(disk, row);
    float* const start = farthest_.data() + std::ptrdiff_t{row} * columns_;
    for (int column = first; column < end; ++column) start[column] = std::min(start[column], far);
  }
}

bool OccluderGrid::hides(const Sphere& ball) const {
  const Sphere seen{eyeFromWorldPoint(view_, ball.center), ball.radius};
  const double nearest = -seen.center.z - seen.radius;
  if (empty() || !(nearest > view_.near) || !std::isfinite(seen.radius)) return false;
  Circle circle = around(seen);
  circle.radius += kBesidePx;
  if (!std::isfinite(circle.radius) || !std::isfinite(glm::length(circle.middle))) return false;
  const float near = std::nextafter(static_cast<float>(nearest), 0.0f);
  const Run rows = rowsOf(circle);
  for (int row = rows.first; row < rows.end; ++row) {
    const auto [first, end] = reached(circle, row);
    const float* const start = farthest_.data() + std::ptrdiff_t{row} * columns_;
    if (!std::all_of(start + first, start + std::max(first, end), [&](float far) { return far < near; }))
      return false;
  }
  return true;
}

}  // namespace luxo
