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

/// Triangles. A draw of its own costs a CPU device about as much as a cluster.
constexpr std::uint32_t kShortGap = kClusterTriangles;

/// A more uneven scale would leave the eye's place among the triangles off by more than a billionth.
constexpr double kMaxUneven = 1e3;

/// Whether the triangles of clusters certainly show the face that is not drawn.
class Facing {
 public:
  Facing(const View& view, const SnapshotNode& node, Faces faces)
      : view_(view), place_(eyeFromObject(view, node.worldFromObject)), faces_(faces) {
    const double determinant = std::abs(glm::determinant(place_.linear));
    largest_ = largestStretch(place_.linear);
    // The product of all three, over the largest two at most.
    smallest_ = determinant / (largest_ * largest_) * (1 - 1e-6);
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
      outlined_(drawnFrustum(view, true)) {}

std::vector<TriangleRange> ClusterCulling::drawn(const SnapshotNode& node, Faces faces, bool lines,
                                                 ClusterCounts& counts) const {
  const SurfaceTriangles& triangles = *node.surface.triangles();
  const double slack = vertexSlack(view_, node);
  const Frustum& frustum = lines ? outlined_ : filled_;
  const Facing facing(view_, node, backface_ ? faces : Faces::Both);
  std::vector<TriangleRange> ranges;
  ClusterCounts gap;
  for (const MeshCluster& cluster : triangles.mesh.clusters()) {
    if (cluster.firstTriangle < triangles.first || cluster.firstTriangle >= triangles.first + triangles.count)
      continue;
    const std::uint32_t first = cluster.firstTriangle - triangles.first;
    if (frustum_ && std::isfinite(slack) && outside(frustum, node.worldFromObject, cluster.bounds, slack)) {
      gap.culledFrustum += cluster.triangles;
    } else if (facing.showsOther(cluster)) {
      gap.culledBackface += cluster.triangles;
    } else {
      const bool joins = !ranges.empty() && first - (ranges.back().first + ranges.back().count) <= kShortGap;
      if (joins) {
        ranges.back().count = first + cluster.triangles - ranges.back().first;
      } else {
        counts.culledFrustum += gap.culledFrustum;
        counts.culledBackface += gap.culledBackface;
        ranges.push_back({first, cluster.triangles});
      }
      gap = {};
    }
  }
  counts.culledFrustum += gap.culledFrustum;
  counts.culledBackface += gap.culledBackface;
  return ranges;
}

}  // namespace luxo
