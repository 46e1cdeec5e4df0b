// SPDX-License-Identifier: Apache-2.0
#include "draw/instance_data.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "draw/pixel_rows.h"
#include "math/frustum.h"
#include "math/transform.h"
#include "surface/spread.h"

namespace luxo {
namespace {

Vec3f toFloat(const Vec3& v) { return Vec3f(v); }

std::uint32_t flagsOf(const SnapshotNode& node, const VisibleNode& visible) {
  return (visible.twoSided ? shared::kTwoSided : 0) | (node.surface.flatNormal() ? shared::kPlane : 0);
}

/// Of the object's plane y = 0.
bool seenFromAbove(const View& view, const Transform& worldFromObject) {
  const Vec3 toViewer = view.perspective() ? view.eye - worldFromObject.translation : -view.forward();
  return glm::dot(glm::cross(worldFromObject.linear[2], worldFromObject.linear[0]), toViewer) > 0;
}

/// Straight ahead of the eye, in the middle of what the picture shows, where that is far enough away.
std::optional<Vec3> farMiddleSeen(const Snapshot& snapshot) {
  const View& view = snapshot.view;
  const double width = 2 * glm::length(view.halfExtent);
  // The nearer end is wider than that already.
  if (view.perspective() && kFarEye * width > 1) return std::nullopt;
  const Frustum frustum = frustumOf(view);
  double nearest = std::numeric_limits<double>::infinity(), farthest = -nearest;
  for (const SnapshotNode& node : snapshot.nodes) {
    if (!isFinite(node.boundsWorld)) return std::nullopt;
    if (outside(frustum, sphereAround(node.boundsWorld))) continue;
    const auto seen = depthsSeen(view, node);
    if (!seen) continue;
    nearest = std::min(nearest, seen->nearest);
    farthest = std::max(farthest, seen->farthest);
    const double size = std::hypot(farthest - nearest, view.perspective() ? width * farthest : width);
    if (!(0.5 * (nearest + farthest) > kFarEye * size)) return std::nullopt;
  }
  if (!(nearest <= farthest)) return std::nullopt;
  return view.eye + 0.5 * (nearest + farthest) * view.forward();
}

}  // namespace

Vec3f vertexMiddle(const SnapshotNode& node, const Vec3& shadingOrigin, const Vec3& origin) {
  if (!node.surface.isPolygonal()) return Vec3f(0);
  const Transform& place = node.worldFromObject;
  const Vec3 middle = glm::inverse(place.linear) * (shadingOrigin - place.translation) - origin;
  // What is rounded is relative to these lengths: of a node's own T R S at most the square root of 3 times
  // the distance, of one that its parents shear any number of times that.
  double lengths = 0;
  for (int i = 0; i < 3; ++i) lengths += glm::length(place.linear[i]) * std::abs(middle[i]);
  const bool isNear = lengths <= 2 * glm::distance(transformPoint(place, origin), shadingOrigin);
  return isNear ? Vec3f(middle) : Vec3f(0);
}

shared::InstanceData instanceData(const Snapshot& snapshot, const SnapshotNode& node,
                                  const VisibleNode& visible, const Vec3& shadingOrigin, const Vec3& origin,
                                  bool showsBack) {
  const Domain& domain = node.surface.domain();
  const Mat3 normals = normalMatrix(node.worldFromObject.linear);
  double largest = 0;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) largest = std::max(largest, std::abs(normals[column][row]));
  const Mat3f linear(node.worldFromObject.linear);
  const Vec3f middle = vertexMiddle(node, shadingOrigin, origin);
  return {.relativeFromObject = {Vec4f(linear[0], middle.x), Vec4f(linear[1], middle.y),
                                 Vec4f(linear[2], middle.z)},
          .translation = toFloat(transformPoint(node.worldFromObject, origin + Vec3(middle)) - shadingOrigin),
          .normalFromObject = Mat3f(largest > 0 ? normals / largest : normals),
          .flags = flagsOf(node, visible) | (showsBack ? shared::kShowsBack : 0) |
                   (seenFromAbove(snapshot.view, node.worldFromObject) ? shared::kFromAbove : 0),
          .material = 0,
          .id = node.number,
          .domain = Vec4f(domain.u.lo, domain.v.lo, domain.u.width(), domain.v.width())};
}

Vec3 shadingOrigin(const Snapshot& snapshot) {
  Box all;
  for (const SnapshotNode& node : snapshot.nodes)
    if (isFinite(node.boundsWorld)) all.add(node.boundsWorld);
  const Vec3& eye = snapshot.view.eye;
  if (all.empty()) return eye;
  if (glm::distance(eye, all.center()) > kFarEye * glm::length(all.extent())) return all.center();
  return farMiddleSeen(snapshot).value_or(eye);
}

shared::ViewData viewData(const Snapshot& snapshot, const VisibleList& visible, const Vec3& origin) {
  const View& view = snapshot.view;
  // The nearest and farthest depth any visible node can have: the scale of the depth view.
  double nearest = std::numeric_limits<double>::infinity(), farthest = view.near;
  for (const auto* list : {&visible.opaque, &visible.transparent})
    for (const VisibleNode& v : *list) {
      const Sphere sphere = sphereAround(snapshot.nodes[v.node].boundsWorld);
      nearest = std::min(nearest, v.nearestDepth);
      farthest = std::max(farthest, v.centerDepth + sphere.radius);
    }
  const Vec3 fromEye = origin - view.eye;
  Mat4 eyeFromRelative(view.eyeFromWorld);
  eyeFromRelative[3] = Vec4(view.eyeFromWorld * fromEye, 1);
  const double depth = glm::dot(fromEye, view.forward());
  const Vec3 right = view.right() / view.pixelsPerUnit, down = -view.up() / view.pixelsPerUnit,
             aside = right * view.sampleOffsetPx.x + down * view.sampleOffsetPx.y;
  // Of what is right of and below the middle: at that depth, and for each metre.
  const double widening = view.perspective() ? depth : 1, spread = view.perspective() ? 1 : 0;
  return {.clipFromRelative = Mat4f(view.clipFromEye * eyeFromRelative),
          .viewer = view.perspective() ? Vec4f(toFloat(-fromEye), 1) : Vec4f(toFloat(-view.forward()), 0),
          .forward = Vec4f(Vec4(view.forward(), depth)),
          .depthRange = Vec2f(std::min(nearest, farthest), farthest),
          .placeMiddle = toFloat(widening * aside + depth * view.forward() - fromEye),
          .placeRight = toFloat(widening * right),
          .placeDown = toFloat(widening * down),
          .rayMiddle = toFloat(spread * aside + view.forward()),
          .rayRight = toFloat(spread * right),
          .rayDown = toFloat(spread * down),
          .middle = Vec2f(0.5 * view.size.width, 0.5 * view.size.height),
          .occlusionRadius = static_cast<float>(snapshot.ambientOcclusion.radius)};
}

}  // namespace luxo
