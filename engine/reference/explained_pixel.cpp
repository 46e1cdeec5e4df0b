// SPDX-License-Identifier: Apache-2.0
#include "reference/explained_pixel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "reference/caster.h"

namespace luxo {
namespace {

using reference::Caster;
using reference::Hit;
using reference::Ray;

constexpr double kSamePoint = 1e-9;  // of the distance: one root, found by two searches

/// The same surfaces, each of which one sees through.
Snapshot transparent(Snapshot snapshot) {
  for (Material& material : snapshot.materials) material.opacity = 0.5;
  return snapshot;
}

std::vector<LightOnPoint> lightsOn(const Caster& caster, const Hit& hit, const Vec3& toViewer) {
  struct Sum {
    LightOnPoint light;
    Vec4 position{0};
    double cone = 0;
  };
  std::map<std::uint32_t, Sum> sums;
  const std::vector<SnapshotLight>& lights = caster.snapshot().lights;
  for (std::uint32_t i = 0; i < lights.size(); ++i) {
    Sum& sum = sums[lights[i].id.index];
    const Caster::Lit lit = caster.lightAt(i, hit, toViewer);
    sum.light.light = lights[i].id;
    sum.position += lights[i].positionWorld;
    sum.light.radiance += lit.radiance;
    sum.light.arriving += lit.radiance * lit.reaching;
    sum.light.unshadowed += lit.unshadowed;
    sum.light.share += lit.share;
    sum.light.visibility += lit.reaching;
    sum.light.faces |= caster.faces(i, hit);
    sum.cone += lights[i].coneTo(hit.position);
    sum.light.shadows |= lights[i].hasShadow();
    sum.light.certified &= lit.certified;
    ++sum.light.points;
  }
  std::vector<LightOnPoint> all;
  for (auto& [node, sum] : sums) {
    LightOnPoint& light = sum.light;
    const double count = light.points;
    const bool directional = sum.position.w == 0;
    const Vec3 way = Vec3(sum.position) / count - (directional ? Vec3(0) : hit.position);
    light.toward = unit(way);
    light.distance = directional ? std::numeric_limits<double>::infinity() : glm::length(way);
    light.cosine = glm::dot(light.toward, hit.normal);
    light.visibility /= count;
    light.cone = sum.cone / count;
    all.push_back(light);
  }
  return all;
}

class Explanation {
 public:
  Explanation(const Snapshot& snapshot, const Vec2& at)
      : snapshot_(snapshot),
        through_(transparent(snapshot)),
        caster_(snapshot_, cache_, reference::Cells::WhereRaysGo),
        behind_(through_, cache_, reference::Cells::WhereRaysGo),
        ray_(caster_.rayThrough(at.x, at.y)) {
    pixel_.at = at;
    pixel_.origin = ray_.origin;
    pixel_.direction = ray_.direction;
  }

  ExplainedPixel explain() {
    const Caster::Sight sight = caster_.look(ray_, Caster::Invisible::Told);
    const Caster::Sight all = behind_.look(ray_, Caster::Invisible::Told);
    pixel_.certified = sight.certified;
    pixel_.color = caster_.color(ray_, caster_.look(ray_), pixel_.certified);
    for (const Hit& hit : sight.hits) {
      pixel_.points.push_back(seen(hit));
      if (!materialOf(hit.node).transparent()) break;
    }
    const std::vector<PointOnRay> known = pixel_.points;
    for (const Hit& hit : all.hits) {
      const auto same = [&](const PointOnRay& point) {
        return point.node == hit.node && std::abs(point.distance - hit.t) <= kSamePoint * hit.t;
      };
      if (std::ranges::any_of(known, same)) continue;
      pixel_.points.push_back(placed(hit));
      pixel_.points.back().seen = false;
    }
    return std::move(pixel_);
  }

 private:
  [[nodiscard]] PointOnRay placed(const Hit& hit) const {
    const SnapshotNode& node = snapshot_.nodes[hit.node];
    PointOnRay point{.node = hit.node,
                     .parameters = {hit.u, hit.v},
                     .position = hit.position,
                     .depth = glm::dot(ray_.direction, snapshot_.view.forward()) * hit.t,
                     .distance = hit.t,
                     .outward = hit.facet,
                     .lit = hit.normal,
                     .certified = hit.certified};
    if (!node.surface.isParametric()) {
      point.positionObject =
          glm::inverse(node.worldFromObject.linear) * (hit.position - node.worldFromObject.translation);
    } else {
      point.patch = node.surface.patchAt(hit.u, hit.v);
      point.positionObject = node.surface.position(point.patch, hit.u, hit.v, node.parameters);
      point.position = transformPoint(node.worldFromObject, point.positionObject);
      point.outward = unit(normalMatrix(node.worldFromObject.linear) *
                           node.surface.normal(point.patch, hit.u, hit.v, node.parameters));
      point.curvature =
          curvatureAt(node.surface, point.patch, hit.u, hit.v, node.parameters, node.worldFromObject.linear);
      point.residualPx = glm::distance(
          pixelFromEye(snapshot_.view, eyeFromWorldPoint(snapshot_.view, point.position)), pixel_.at);
    }
    point.front = glm::dot(point.outward, ray_.direction) <= 0;
    return point;
  }

  [[nodiscard]] const Material& materialOf(std::uint32_t node) const {
    return snapshot_.materials[snapshot_.nodes[node].material.index];
  }

  [[nodiscard]] PointOnRay seen(const Hit& hit) const {
    PointOnRay point = placed(hit);
    point.diffuse = caster_.diffuseOf(hit);
    point.opacity = caster_.opacityOf(hit);
    point.ambient = point.reflected = caster_.withoutLights(hit);
    point.lights = lightsOn(caster_, hit, -ray_.direction);
    for (const LightOnPoint& light : point.lights) point.reflected += light.share;
    return point;
  }

  const Snapshot snapshot_, through_;
  reference::ShapeCache cache_;
  Caster caster_, behind_;
  Ray ray_;
  ExplainedPixel pixel_;
};

}  // namespace

ExplainedPixel explainPixel(const Snapshot& snapshot, const Vec2& at) {
  return Explanation(withExactShadows(snapshot), at).explain();
}

}  // namespace luxo
