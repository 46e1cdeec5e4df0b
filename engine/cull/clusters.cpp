// SPDX-License-Identifier: Apache-2.0
#include "cull/clusters.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "cull/raster_slack.h"
#include "surface/surface_triangles.h"

namespace luxo {
namespace {

/// A more uneven scale would leave the eye's place among the triangles off by more than a billionth.
constexpr double kMaxUneven = 1e3;

/// Depths, near / depth, are off by some four units of 2^-24 of the largest of their triangle, so by four
/// times that part of themselves: as much as vertices may be (kVertexSlack).
constexpr double kDeep = 4;

/// What the depths of parallel rays are off by, metres: the same units of all that the picture may hold.
double depthSlack(const View& view) { return view.perspective() ? 0 : 0x1p-22 * (view.far - view.near); }

/// How much vectors grow at least: the product of all three stretches over the largest two, at most.
double smallestStretch(const Mat3& linear) {
  const double largest = largestStretch(linear);
  return std::abs(glm::determinant(linear)) / (largest * largest) * (1 - 1e-6);
}

/// Whether the triangles of clusters certainly show the face that is not drawn.
class Facing {
 public:
  Facing(const View& view, const SnapshotNode& node, Faces faces)
      : view_(view), place_(eyeFromObject(view, node.worldFromObject)), faces_(faces) {
    largest_ = largestStretch(place_.linear);
    smallest_ = smallestStretch(place_.linear);
    certain_ = faces != Faces::Both && largest_ < kMaxUneven * smallest_;
    if (!certain_) return;
    const Mat3 objectFromEye = glm::inverse(place_.linear);
    const Vec3 toward = view.perspective() ? -place_.translation : Vec3(0, 0, 1);
    eye_ = Vec4(objectFromEye * toward, view.perspective() ? 1 : 0);
    // Rounding of the inverse, below 2^-52 times the square of kMaxUneven, and of the place.
    eyeSlack_ =
        1e-9 * glm::length(Vec3(eye_)) +
        1e-15 * eye_.w * (glm::length(view.eye) + glm::length(node.worldFromObject.translation)) / smallest_;
    vertexSlack_ = vertexSlack(view, node);
    // Of what is clipped other polygons are left, which may be as narrow as they like.
    View fromEye = view;
    fromEye.eye = Vec3(0);
    fromEye.eyeFromWorld = Mat3(1);
    clip_ = frustumOf(fromEye, -std::max(std::abs(view.sampleOffsetPx.x), std::abs(view.sampleOffsetPx.y)));
  }

  [[nodiscard]] bool showsOther(const MeshCluster& cluster) const {
    if (!certain_) return false;
    const double offPlanes = faces_ == Faces::Front ? cluster.behind(eye_) : cluster.before(eye_);
    const double distance = smallest_ * (offPlanes - eyeSlack_);  // of parallel rays the sine
    if (!(distance > 0)) return false;
    const Sphere sphere{transformPoint(place_, cluster.sphere.center), largest_ * cluster.sphere.radius};
    if (!inside(clip_, sphere, vertexSlack_)) return false;
    const double f = view_.pixelsPerUnit, height = smallest_ * cluster.thinnest;
    if (!view_.perspective()) return f * height * distance > 2 * (snap() + f * vertexSlack_);
    const double radius = sphere.radius + vertexSlack_, nearest = -sphere.center.z - radius,
                 farthest = -sphere.center.z + radius, reach = glm::length(sphere.center) + radius,
                 perMetre = f * reach / (nearest * nearest);
    return f * height * distance * nearest * nearest / (farthest * farthest * farthest * reach) >
           2 * (snap() + perMetre * vertexSlack_);
  }

 private:
  static double snap() { return std::numbers::sqrt2 * kSnapPx; }

  const View& view_;
  Transform place_;
  Faces faces_;
  double largest_ = 0, smallest_ = 0;  ///< stretch, at most and at least
  bool certain_ = false;
  Vec4 eye_{0};   ///< in the object's space, as MeshCluster has it
  Frustum clip_;  ///< in the eye's
  double eyeSlack_ = 0, vertexSlack_ = 0;
};

}  // namespace

ClusterCulling::ClusterCulling(const View& view, const CullOptions& options)
    : view_(view),
      frustum_(options.frustum),
      backface_(options.backface),
      filled_(drawnFrustum(view, false)),
      outlined_(drawnFrustum(view, true)),
      grid_(view) {}

void ClusterCulling::occlude(const SnapshotNode& solid, std::span<const Sphere> balls) {
  if (balls.empty()) return;
  const Transform& place = solid.worldFromObject;
  const double slack = 2 * vertexSlack(view_, solid) + depthSlack(view_),
               largest = largestStretch(place.linear), smallest = smallestStretch(place.linear);
  if (!std::isfinite(slack) || !(smallest > 0)) return;
  const auto isOpen = [&](const MeshCluster& cluster) {
    return !isShallow(
               {transformPoint(place, cluster.sphere.center), largest * cluster.sphere.radius + slack}) &&
           !outside(filled_, place, cluster.bounds, slack);
  };
  if (std::ranges::any_of(solid.surface.triangles()->mesh.clusters(), isOpen)) return;
  for (const Sphere& ball : balls)
    grid_.cover({transformPoint(place, ball.center), smallest * ball.radius}, slack);
}

bool ClusterCulling::isShallow(const Sphere& world) const {
  const double depth = -eyeFromWorldPoint(view_, world.center).z, nearest = depth - world.radius,
               farthest = depth + world.radius;
  return nearest > view_.near && (!view_.perspective() || farthest <= kDeep * nearest);
}

std::vector<TriangleRange> ClusterCulling::drawn(const SnapshotNode& node, const ClusterNeeds& needs,
                                                 ClusterCounts& counts) const {
  const SurfaceTriangles& triangles = *node.surface.triangles();
  const Transform& place = node.worldFromObject;
  const double slack = vertexSlack(view_, node), largest = largestStretch(place.linear);
  const Frustum& frustum = needs.lines ? outlined_ : filled_;
  const Facing facing(view_, node, backface_ ? needs.faces : Faces::Both);
  const bool mayBeHidden = needs.mayBeHidden && !grid_.empty() && std::isfinite(slack);
  const auto isHidden = [&](const Sphere& sphere) {
    if (!mayBeHidden) return false;
    const Sphere grown{transformPoint(place, sphere.center),
                       largest * sphere.radius + 2 * slack + depthSlack(view_)};
    return isShallow(grown) && grid_.hides(grown);
  };
  std::vector<TriangleRange> ranges;
  for (const MeshCluster& cluster : triangles.mesh.clusters()) {
    if (cluster.firstTriangle < triangles.first || cluster.firstTriangle >= triangles.first + triangles.count)
      continue;
    const std::uint32_t first = cluster.firstTriangle - triangles.first;
    if (frustum_ && std::isfinite(slack) && outside(frustum, place, cluster.bounds, slack)) {
      counts.culledFrustum += cluster.triangles;
    } else if (facing.showsOther(cluster)) {
      counts.culledBackface += cluster.triangles;
    } else if (isHidden(cluster.sphere)) {
      counts.culledHidden += cluster.triangles;
    } else if (!ranges.empty() && first == ranges.back().first + ranges.back().count) {
      ranges.back().count += cluster.triangles;
    } else {
      ranges.push_back({first, cluster.triangles});
    }
  }
  return ranges;
}

}  // namespace luxo
