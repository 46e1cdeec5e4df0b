// SPDX-License-Identifier: Apache-2.0
#include "scene/light_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/error.h"
#include "math/transform.h"
#include "surface/spread.h"

namespace luxo {
namespace {

/// Beyond that many times its distance ahead a single picture would be mostly empty: 63 degrees aside.
constexpr double kWidest = 2;
/// Of the farthest distance: what is nearer to a point light is taken to be there.
constexpr double kNearest = 1e-4;
/// A texel on either side, for what is rounded.
double withMargin(double half, int size) { return half * (1 + 2.0 / size); }

Vec3 acrossOf(const Vec3& direction) {
  const Vec3 axis = std::abs(direction.y) < 0.9 ? Vec3(0, 1, 0) : Vec3(0, 0, 1);
  return unit(axis - glm::dot(axis, direction) * direction);
}

View directionalView(const Vec3& toward, const Box& casters, const Box& receivers, int size) {
  const Vec3 up = acrossOf(toward), right = glm::cross(up, toward);
  const auto extentOf = [&](const Box& box, const Vec3& axis) {
    Interval extent{glm::dot(box.center(), axis), glm::dot(box.center(), axis)};
    for (const Vec3& corner : cornersOf(box)) {
      extent.lo = std::min(extent.lo, glm::dot(corner, axis));
      extent.hi = std::max(extent.hi, glm::dot(corner, axis));
    }
    return extent;
  };
  // Nothing is in shadow but beside what is seen.
  const auto common = [&](const Vec3& axis) {
    const Interval casts = extentOf(casters, axis), seen = extentOf(receivers, axis);
    const Interval both{std::max(casts.lo, seen.lo), std::min(casts.hi, seen.hi)};
    return both.lo < both.hi ? both : casts;
  };
  const Interval x = common(right), y = common(up), depth = extentOf(casters, -toward);
  const double side = std::max({x.width(), y.width(), 1e-6 * glm::length(casters.extent()), 1e-30});
  const double before = std::max(depth.width(), side);
  const Vec3 eye = 0.5 * (x.lo + x.hi) * right + 0.5 * (y.lo + y.hi) * up - (depth.lo - before) * toward;
  const Camera camera{.eye = eye,
                      .lookAt = eye - before * toward,
                      .up = up,
                      .near = 0.5 * before,
                      .projection = Projection::Orthographic,
                      .height = withMargin(side, size)};
  return viewAt(camera, {}, {size, size}, casters);
}

/// `distance`: to what there is, so that rounding leaves something of the way there.
View pointView(const Vec3& at, const Vec3& toward, double distance, double tangent, double near, int size) {
  const Camera camera{.eye = at,
                      .lookAt = at + distance * toward,
                      .up = acrossOf(toward),
                      .fovY = 2 * std::atan(tangent),
                      .near = near};
  return viewAt(camera, {}, {size, size});
}

}  // namespace

Vec4 parallelWhereFar(const Vec4& light, const Box& all, double most) {
  if (light.w == 0 || all.empty() || !isFinite(all)) return light;
  const Vec3 way = Vec3(light) - all.center();
  return most * glm::length(way) > glm::length(all.extent()) ? Vec4(unit(way), 0) : light;
}

SnapshotLight asMapped(SnapshotLight light, const Box& casters, const Box& receivers, int size) {
  const Vec3 way = Vec3(light.positionWorld) - receivers.center();
  if (light.directional() || !(glm::length(way) > 0)) return light;
  const Vec3 toward = unit(way);
  const double texel = 1 / directionalView(toward, casters, receivers, size).pixelsPerUnit;
  Box all = casters;
  all.add(receivers);
  // A ray from the rim of what receives is so much askew, and may be as long as all there is.
  const double askew = 0.5 * glm::length(receivers.extent()) / glm::length(way);
  if (askew * glm::length(all.extent()) > 0.25 * texel) return light;
  if (light.map)
    light.map->radius =
        std::atan(light.map->radius / glm::distance(Vec3(light.positionWorld), casters.center()));
  light.positionWorld = Vec4(toward, 0);
  return light;
}

std::vector<View> lightViews(const SnapshotLight& light, const Box& casters, const Box& receivers, int size) {
  const Vec3 at(light.positionWorld);
  if (light.directional()) return {directionalView(at, casters, receivers, size)};
  const double farthest = glm::distance(at, casters.center()) + glm::length(casters.extent());
  const double distance = glm::distance(at, glm::clamp(at, casters.min, casters.max));
  const double near = std::max({0.5 * distance, kNearest * farthest, 1e-30});
  const Vec3 way = casters.center() - at;
  const Vec3 ahead = glm::length(way) > 0 ? unit(way) : Vec3(0, -1, 0);
  double widest = distance > 0 ? 0 : 2 * kWidest;
  const Vec3 up = acrossOf(ahead), right = glm::cross(ahead, up);
  for (const Vec3& corner : cornersOf(casters)) {
    const Vec3 to = corner - at;
    const double depth = glm::dot(to, ahead);
    const double aside = std::max(std::abs(glm::dot(to, right)), std::abs(glm::dot(to, up)));
    widest = std::max(widest, aside <= kWidest * depth ? aside / depth : 2 * kWidest);
  }
  // What a spot's cone does not hold has no light to lose; its border, where texels beyond are taken for lit,
  // has none either.
  if (const double cone = light.cone ? std::tan(light.cone->outer) : kInfinity;
      cone < std::min(widest, kWidest))
    return {pointView(at, light.cone->axis, farthest, withMargin(cone, size), near, size)};
  if (widest <= kWidest)
    return {pointView(at, ahead, farthest, withMargin(std::max(widest, 1e-9), size), near, size)};
  std::vector<View> views;
  for (const Vec3& axis :
       {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0), Vec3(0, 0, 1), Vec3(0, 0, -1)})
    views.push_back(pointView(at, axis, farthest, withMargin(1, size), kNearest * farthest, size));
  return views;
}

Snapshot seenFromLight(Snapshot snapshot, std::optional<int> size, NodeId light) {
  std::erase_if(snapshot.lights, [&](const SnapshotLight& one) {
    return !one.hasShadow() || (light.valid() && one.id != light);
  });
  if (snapshot.lights.empty() && light.valid())
    throw Error(ErrorKind::Scene, "the light has no shadow then: it has no depth picture",
                "it has a \"shadow\" where it and what casts one are visible");
  if (snapshot.lights.empty())
    throw Error(ErrorKind::Scene, "no light of the scene has a shadow: none has a depth picture",
                "give a light a \"shadow\"");
  SnapshotLight seen = *std::ranges::min_element(snapshot.lights, {}, &SnapshotLight::id);
  if (seen.pointOf) seen.positionWorld = seen.pointOf->middle;
  std::erase_if(snapshot.nodes, [&](const SnapshotNode& node) {
    return std::ranges::find(seen.casters, node.id) == seen.casters.end() ||
           !(largestStretch(node.worldFromObject.linear) > 0);
  });
  Box casters = framingOf(snapshot);
  if (seen.map) {
    std::erase_if(snapshot.nodes, [&](const SnapshotNode& node) {
      return snapshot.materials[node.material.index].letsLightThrough();
    });
    // Of an empty one the view is that of what is not in it.
    if (!snapshot.nodes.empty()) casters = framingOf(snapshot);
  }
  if (casters.empty()) throw Error(ErrorKind::Scene, "what casts the light's shadow has no points");
  // What no perspective view has room for; a nearer light's depths are distances from it.
  seen.positionWorld = parallelWhereFar(seen.positionWorld, casters, 0x1p-30);
  const int usual = seen.map ? static_cast<int>(seen.map->size)
                             : std::min(snapshot.view.size.width, snapshot.view.size.height);
  const std::vector<View> views = lightViews(seen, casters, casters, size.value_or(usual));
  const Vec3 at(seen.positionWorld), way = casters.center() - at;
  snapshot.view = views.size() == 1 ? views[0]
                                    : pointView(at, glm::length(way) > 0 ? unit(way) : Vec3(0, -1, 0),
                                                glm::length(casters.extent()), kWidest, views[0].near,
                                                size.value_or(usual));
  return snapshot;
}

}  // namespace luxo
