// SPDX-License-Identifier: Apache-2.0
#include "draw/triangle_precision.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>

#include "draw/instance_data.h"
#include "math/transform.h"
#include "surface/surface_triangles.h"

namespace luxo {
namespace {

/// Half of what an outline may be off; the raster's own steps are a fifth.
constexpr double kMaxTrianglePx = 0.005;
/// Of each length that is added up on the way from object to clip space: three products and sums, twice.
constexpr double kVertexRounding = 6 * 0x1p-24;

/// What rounding moves the corners of triangles by.
class Rounding {
 public:
  Rounding(const View& view, const SnapshotNode& node, const VisibleNode& visible, const Vec3& origin,
           const Vec3& vertexOrigin)
      : place_(node.worldFromObject),
        origin_(origin),
        vertexOrigin_(vertexOrigin),
        middle_(vertexOrigin + Vec3(vertexMiddle(node, origin, vertexOrigin))),
        columns_(glm::length(place_.linear[0]), glm::length(place_.linear[1]), glm::length(place_.linear[2])),
        stretch_(visible.stretch),
        isStored_(vertexOrigin != node.surface.triangles()->mesh.origin()) {
    translation_ = glm::distance(transformPoint(place_, middle_), origin_);
    const double slant = view.perspective() ? 1 + glm::length(view.halfExtent) : 1;
    pixels_ = kVertexRounding * view.pixelsPerUnit * slant;
    everywhere_ = pixels_ * (view.perspective() ? slant : glm::length(view.halfExtent));
  }

  /// The lengths that are added up for a corner.
  [[nodiscard]] double lengths(const Vec3& corner) const {
    double sum = glm::dot(columns_, glm::abs(corner - middle_)) +
                 glm::distance(transformPoint(place_, corner), origin_) + translation_;
    if (isStored_) sum += stretch_ * glm::distance(corner, vertexOrigin_);
    return sum;
  }
  /// The most for any point between these, as they are convex.
  template <std::size_t count>
  [[nodiscard]] double lengths(const std::array<Vec3, count>& corners) const {
    double most = 0;
    for (const Vec3& corner : corners) most = std::max(most, lengths(corner));
    return most;
  }

  /// The depth, of parallel rays 1 for any, nearer than which a corner of such lengths may be moved too far.
  [[nodiscard]] double blurredDepth(double lengths) const {
    const double left = kMaxTrianglePx - everywhere_;
    return left > 0 ? pixels_ * lengths / left : std::numeric_limits<double>::infinity();
  }

 private:
  Transform place_;
  Vec3 origin_, vertexOrigin_, middle_, columns_;  ///< columns_: their lengths
  double stretch_, translation_ = 0;
  bool isStored_;          ///< as other floats than the triangles' own
  double pixels_ = 0;      ///< for each metre of lengths, at a depth of 1
  double everywhere_ = 0;  ///< on the way to the picture, whatever the lengths
};

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

/// Of triangles, in the picture.
class NearPart {
 public:
  explicit NearPart(const View& view)
      : size_(view.size), near_(0.5 * view.near), half_(0.5 * size_.width + 2, 0.5 * size_.height + 2) {}

  /// Adds the pixels of the part that is nearer to the eye than that.
  void add(Polygon& polygon, double depth, std::vector<PixelRect>& rects) const {
    clip(polygon, [&](const Vec3& p) { return p.z - near_; });
    clip(polygon, [&](const Vec3& p) { return depth - p.z; });
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
  double near_;
  Vec2 half_;
};

}  // namespace

void appendBlurred(const View& view, const SnapshotNode& node, const VisibleNode& visible, const Vec3& origin,
                   const Vec3& vertexOrigin, std::vector<PixelRect>& rects) {
  const Rounding rounding(view, node, visible, origin, vertexOrigin);
  const double depth = rounding.blurredDepth(rounding.lengths(cornersOf(node.boundsObject)));
  if (view.perspective() ? !std::isfinite(depth) : depth > 1) {
    rects.push_back(pixelsOf(view, node.boundsWorld));
    return;
  }
  if (!view.perspective() || !(depth > visible.nearestDepth)) return;
  const PixelRows rows = pixelRows(view, node.worldFromObject);
  const SurfaceTriangles& triangles = *node.surface.triangles();
  const NearPart part(view);
  const auto before = static_cast<std::ptrdiff_t>(rects.size());
  Polygon polygon;
  for (const MeshCluster& cluster : triangles.mesh.clusters()) {
    const std::uint32_t first = std::max(cluster.firstTriangle, triangles.first),
                        end = std::min(cluster.firstTriangle + cluster.triangles,
                                       triangles.first + triangles.count);
    const double nearest =
        glm::dot(rows.depth, Vec4(cluster.sphere.center, 1)) - visible.stretch * cluster.sphere.radius;
    if (nearest > rounding.blurredDepth(rounding.lengths(cornersOf(cluster.bounds)))) continue;
    for (std::uint32_t i = first; i < end; ++i) {
      const std::array<Vec3, 3> corners = triangles.points(i - triangles.first);
      polygon.clear();
      for (const Vec3& point : corners) {
        const Vec4 p(point, 1);
        polygon.emplace_back(glm::dot(rows.x, p), glm::dot(rows.y, p), glm::dot(rows.depth, p));
      }
      part.add(polygon, rounding.blurredDepth(rounding.lengths(corners)), rects);
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
