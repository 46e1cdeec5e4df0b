// SPDX-License-Identifier: Apache-2.0
#include "draw/pixel_rows.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <utility>
#include <vector>

namespace luxo {
namespace {

/// What an inverse may be off by.
constexpr double kMaxOffPx = 1e-6;

/// Row `row` of clipFromEye as a linear function of the object's points.
Vec4 clipRow(const View& view, const Transform& eyeFromObject, int row) {
  Vec3 inEye;
  for (int column = 0; column < 3; ++column) inEye[column] = view.clipFromEye[column][row];
  return {glm::transpose(eyeFromObject.linear) * inEye,
          glm::dot(inEye, eyeFromObject.translation) + view.clipFromEye[3][row]};
}

}  // namespace

namespace {

/// Of corners that begin with x, y and width.
template <class Corner>
std::vector<Corner> clippedPolygon(std::vector<Corner> polygon, const PixelSize& size) {
  const double right = 0.5 * size.width, top = 0.5 * size.height;
  for (const Vec3& side : {Vec3(1, 0, right), Vec3(-1, 0, right), Vec3(0, 1, top), Vec3(0, -1, top)}) {
    std::vector<Corner> part;  // where dot(side, p) >= 0
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Corner &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      const double ofA = glm::dot(side, Vec3(a)), ofB = glm::dot(side, Vec3(b));
      if (ofA >= 0) part.push_back(a);
      if ((ofA >= 0) != (ofB >= 0)) part.push_back(a + ofA / (ofA - ofB) * (b - a));
    }
    polygon = std::move(part);
  }
  return polygon;
}

}  // namespace

std::vector<Vec3> clipped(std::vector<Vec3> polygon, const PixelSize& size) {
  return clippedPolygon(std::move(polygon), size);
}

PixelRows pixelRows(const View& view, const Transform& worldFromObject) {
  const Transform eye = eyeFromObject(view, worldFromObject);
  return {.x = 0.5 * view.size.width * clipRow(view, eye, 0),
          .y = -0.5 * view.size.height * clipRow(view, eye, 1),
          .depth = Vec4(-(glm::transpose(eye.linear) * Vec3(0, 0, 1)), -eye.translation.z)};
}

std::optional<PlaneRows> planeRows(const View& view, const Transform& worldFromObject) {
  const PixelRows rows = pixelRows(view, worldFromObject);
  const Vec4 width = view.perspective() ? rows.depth : Vec4(0, 0, 0, 1);
  const auto column = [&](int along) { return Vec3(rows.x[along], rows.y[along], width[along]); };
  const Mat3 pixelFromPlane(column(0), column(2), column(3));
  const Mat3 planeFromPixel = glm::inverse(pixelFromPlane), error = pixelFromPlane * planeFromPixel - Mat3(1);
  for (const double right : {-0.5, 0.5})
    for (const double down : {-0.5, 0.5}) {
      const Vec2 pixel(right * view.size.width, down * view.size.height);
      const Vec3 off = error * Vec3(pixel, 1);
      if (!(glm::length(Vec2(off) - pixel * off.z) <= kMaxOffPx)) return std::nullopt;
    }
  const Mat3 byRow = glm::transpose(planeFromPixel);
  return PlaneRows{byRow[0], byRow[1], byRow[2]};
}

// Of a solid cut by a pyramid the nearest and the farthest point are on faces of the solid, unless the eye is
// inside.
std::optional<DepthRange> depthsSeen(const View& view, const SnapshotNode& node) {
  const PixelRows rows = pixelRows(view, node.worldFromObject);
  const Box& box = node.boundsObject;
  double nearest = std::numeric_limits<double>::infinity(), farthest = -nearest;
  bool holdsEye = true;
  for (int axis = 0; axis < 3; ++axis) {
    holdsEye = holdsEye && view.eye[axis] >= node.boundsWorld.min[axis] &&
               view.eye[axis] <= node.boundsWorld.max[axis];
    for (const double end : {box.min[axis], box.max[axis]}) {
      std::vector<Vec4> face;  // right, down, width and depth
      for (const auto& [s, t] : {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1)}) {
        Vec4 corner(1);
        corner[axis] = end;
        corner[(axis + 1) % 3] = (s ? box.max : box.min)[(axis + 1) % 3];
        corner[(axis + 2) % 3] = (t ? box.max : box.min)[(axis + 2) % 3];
        const double depth = glm::dot(rows.depth, corner);
        face.emplace_back(glm::dot(rows.x, corner), glm::dot(rows.y, corner), view.perspective() ? depth : 1,
                          depth);
      }
      for (const Vec4& p : clippedPolygon(std::move(face), view.size)) {
        nearest = std::min(nearest, p.w);
        farthest = std::max(farthest, p.w);
      }
    }
  }
  if (holdsEye) {
    nearest = 0;
    farthest = std::max(farthest, view.near);
  }
  if (!(nearest <= farthest) || !(farthest >= view.near)) return std::nullopt;
  return DepthRange{std::max(nearest, view.near), farthest};
}

double nearestSeen(const View& view, const SnapshotNode& node) {
  const auto seen = depthsSeen(view, node);
  return seen ? seen->nearest : std::numeric_limits<double>::infinity();
}

PixelRect overlap(const PixelRect& a, const PixelRect& b) {
  const PixelPlace low{std::max(a.low.x, b.low.x), std::max(a.low.y, b.low.y)};
  return {low,
          {std::max(low.x, std::min(a.high.x, b.high.x)), std::max(low.y, std::min(a.high.y, b.high.y))}};
}

PixelRect pixelsOf(const View& view, const Box& world) {
  const PixelRect all{{0, 0}, {view.size.width, view.size.height}};
  if (world.empty()) return {};
  Vec2 low(std::numeric_limits<double>::infinity()), high = -low;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 point((corner & 1) != 0 ? world.max.x : world.min.x,
                     (corner & 2) != 0 ? world.max.y : world.min.y,
                     (corner & 4) != 0 ? world.max.z : world.min.z);
    const Vec3 eye = eyeFromWorldPoint(view, point);
    if (!std::isfinite(glm::dot(eye, Vec3(1))) || (view.perspective() && !(-eye.z > view.near))) return all;
    const Vec2 pixel = pixelFromEye(view, eye);
    low = glm::min(low, pixel);
    high = glm::max(high, pixel);
  }
  const auto within = [](double x, int size) {
    return static_cast<std::int32_t>(std::clamp(x, 0.0, static_cast<double>(size)));
  };
  // A pixel may be sampled beside its centre, by half a pixel.
  return {{within(std::floor(low.x) - 1, view.size.width), within(std::floor(low.y) - 1, view.size.height)},
          {within(std::ceil(high.x) + 1, view.size.width), within(std::ceil(high.y) + 1, view.size.height)}};
}

}  // namespace luxo
