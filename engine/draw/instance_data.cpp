// SPDX-License-Identifier: Apache-2.0
#include "draw/instance_data.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/transform.h"

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

}  // namespace

shared::InstanceData instanceData(const Snapshot& snapshot, const SnapshotNode& node,
                                  const VisibleNode& visible, const Vec3& origin, bool showsBack) {
  const Domain& domain = node.surface.domain();
  const Mat3 normals = normalMatrix(node.worldFromObject.linear);
  double largest = 0;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) largest = std::max(largest, std::abs(normals[column][row]));
  return {.relativeFromObject = Mat3f(node.worldFromObject.linear),
          .translation = toFloat(transformPoint(node.worldFromObject, origin) - snapshot.view.eye),
          .normalFromObject = Mat3f(largest > 0 ? normals / largest : normals),
          .flags = flagsOf(node, visible) | (showsBack ? shared::kShowsBack : 0) |
                   (seenFromAbove(snapshot.view, node.worldFromObject) ? shared::kFromAbove : 0),
          .material = 0,
          .id = node.number,
          .domain = Vec4f(domain.u.lo, domain.v.lo, domain.u.width(), domain.v.width())};
}

shared::ViewData viewData(const Snapshot& snapshot, const VisibleList& visible) {
  const View& view = snapshot.view;
  // The nearest and farthest depth any visible node can have: the scale of the depth view.
  double nearest = std::numeric_limits<double>::infinity(), farthest = view.near;
  for (const auto* list : {&visible.opaque, &visible.transparent})
    for (const VisibleNode& v : *list) {
      const Sphere sphere = sphereAround(snapshot.nodes[v.node].boundsWorld);
      nearest = std::min(nearest, v.nearestDepth);
      farthest = std::max(farthest, v.centerDepth + sphere.radius);
    }
  Mat4 eyeFromRelative(view.eyeFromWorld);
  const Vec3 right = view.right() / view.pixelsPerUnit, down = -view.up() / view.pixelsPerUnit,
             aside = right * view.sampleOffsetPx.x + down * view.sampleOffsetPx.y;
  return {.clipFromRelative = Mat4f(view.clipFromEye * eyeFromRelative),
          .viewer = view.perspective() ? Vec4f(0, 0, 0, 1) : Vec4f(toFloat(-view.forward()), 0),
          .forward = toFloat(view.forward()),
          .depthRange = Vec2f(std::min(nearest, farthest), farthest),
          .rayMiddle = toFloat(aside + (view.perspective() ? view.forward() : Vec3(0))),
          .rayRight = toFloat(right),
          .rayDown = toFloat(down),
          .rayDepth = toFloat(view.perspective() ? Vec3(0) : view.forward()),
          .middle = Vec2f(0.5 * view.size.width, 0.5 * view.size.height)};
}

}  // namespace luxo
