// SPDX-License-Identifier: Apache-2.0
#include "draw/triangle_precision.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>

#include "math/transform.h"
#include "surface/surface_triangles.h"

namespace luxo {
namespace {

/// Half of what an outline may be off; the raster's own steps are a fifth.
constexpr double kMaxTrianglePx = 0.005;
/// Of each length that is added up on the way from object to clip space: three products and sums, twice.
constexpr double kVertexRounding = 6 * 0x1p-24;

/// Pixels that rounding moves a corner by: `everywhere`, and `near` over its depth.
struct Rounding {
  double everywhere, near;
};

Rounding roundingOf(const View& view, const SnapshotNode& node, const VisibleNode& visible,
                    const Vec3& origin) {
  const Vec3& middle = node.surface.triangles()->mesh.origin();
  double object = 0, relative = 0;
  for (const Vec3& corner : cornersOf(node.boundsObject))
    object = std::max(object, glm::distance(corner, middle));
  for (const Vec3& corner : cornersOf(node.boundsWorld))
    relative = std::max(relative, glm::distance(corner, origin));
  const double lengths = visible.stretch * object + relative +
                         glm::distance(transformPoint(node.worldFromObject, middle), origin);
  const double slant = view.perspective() ? 1 + glm::length(view.halfExtent) : 1;
  const double rounding = kVertexRounding * view.pixelsPerUnit * slant;
  if (view.perspective()) return {rounding * slant, rounding * lengths};
  return {rounding * (glm::length(view.halfExtent) + lengths), 0};
}

/// Corners as right, down and depth, all times the depth but for the last (PixelRows).
using Polygon = std::vector<Vec3>;

/// The part where a linear function of these is not negative.
template <class Function>
void clip(Polygon& polygon, const Function& function) {
  Polygon part;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double ofA = function(a), ofB = function(b);
    if (ofA >= 0) part.push_back(a);
    if ((ofA >= 0) != (ofB >= 0)) part.push_back(glm::mix(a, b, ofA / (ofA - ofB)));
  }
  polygon = std::move(part);
}

/// Nearer to the eye than some depth, in the picture.
class NearPart {
 public:
  NearPart(const View& view, double depth)
      : size_(view.size),
        near_(0.5 * view.near),
        depth_(depth),
        half_(0.5 * size_.width + 2, 0.5 * size_.height + 2) {}

  /// Adds the pixels of a triangle's part.
  void add(Polygon& polygon, std::vector<PixelRect>& rects) const {
    clip(polygon, [&](const Vec3& p) { return p.z - near_; });
    clip(polygon, [&](const Vec3& p) { return depth_ - p.z; });
    for (const double side : {-1.0, 1.0}) {
      clip(polygon, [&](const Vec3& p) { return half_.x * p.z - side * p.x; });
      clip(polygon, [&](const Vec3& p) { return half_.y * p.z - side * p.y; });
    }
    if (polygon.empty()) return;
    Vec2 low(std::numeric_limits<double>::infinity()), high(-low);
    for (const Vec3& p : polygon) {
      low = glm::min(low, Vec2(p) / p.z);
      high = glm::max(high, Vec2(p) / p.z);
    }
    const auto within = [](double x, int most) {
      return static_cast<std::int32_t>(std::clamp(x, 0.0, 1.0 * most));
    };
    const auto x = [&](double at) { return within(at + 0.5 * size_.width, size_.width); };
    const auto y = [&](double at) { return within(at + 0.5 * size_.height, size_.height); };
    const PixelRect rect{{x(std::floor(low.x) - 1), y(std::floor(low.y) - 1)},
                         {x(std::ceil(high.x) + 1), y(std::ceil(high.y) + 1)}};
    if (rect.low.x < rect.high.x && rect.low.y < rect.high.y) rects.push_back(rect);
  }

 private:
  PixelSize size_;
  double near_, depth_;
  Vec2 half_;
};

}  // namespace

void appendBlurred(const View& view, const SnapshotNode& node, const VisibleNode& visible, const Vec3& origin,
                   std::vector<PixelRect>& rects) {
  const Rounding rounding = roundingOf(view, node, visible, origin);
  const double left = kMaxTrianglePx - rounding.everywhere;
  if (!(left > 0)) {
    rects.push_back(pixelsOf(view, node.boundsWorld));
    return;
  }
  const double depth = rounding.near / left;
  if (!view.perspective() || !(depth > visible.nearestDepth)) return;
  const PixelRows rows = pixelRows(view, node.worldFromObject);
  const SurfaceTriangles& triangles = *node.surface.triangles();
  const NearPart part(view, depth);
  const auto before = static_cast<std::ptrdiff_t>(rects.size());
  Polygon polygon;
  for (const MeshCluster& cluster : triangles.mesh.clusters()) {
    const std::uint32_t first = std::max(cluster.firstTriangle, triangles.first),
                        end = std::min(cluster.firstTriangle + cluster.triangles,
                                       triangles.first + triangles.count);
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vec3& corner : cornersOf(cluster.bounds))
      nearest = std::min(nearest, glm::dot(rows.depth, Vec4(corner, 1)));
    if (nearest > depth) continue;
    for (std::uint32_t i = first; i < end; ++i) {
      polygon.clear();
      for (const Vec3& point : triangles.points(i - triangles.first)) {
        const Vec4 p(point, 1);
        polygon.emplace_back(glm::dot(rows.x, p), glm::dot(rows.y, p), glm::dot(rows.depth, p));
      }
      part.add(polygon, rects);
    }
  }
  // Of triangles that all are across the picture one is enough.
  const auto added = rects.begin() + before;
  const PixelRect all{{0, 0}, {view.size.width, view.size.height}};
  const auto pixels =
      std::accumulate(added, rects.end(), std::uint64_t{0},
                      [](std::uint64_t sum, const PixelRect& rect) { return sum + rect.count(); });
  if (pixels <= 4 * all.count()) return;
  rects.erase(added, rects.end());
  rects.push_back(all);
}

}  // namespace luxo
