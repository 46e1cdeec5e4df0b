// SPDX-License-Identifier: Apache-2.0
#include "draw/ray_layers.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "draw/rest_frame.h"
#include "math/numbers.h"
#include "reference/verification.h"

namespace luxo {
namespace {

/// Rounding must not lead across the end of the domain, where a pattern may jump.
Vec2 inside(const Domain& domain, const reference::Hit& hit) {
  const auto within = [](double x, const Interval& range) {
    const double margin = 1e-6 * range.width();
    return std::clamp(x, range.lo + margin, range.hi - margin);
  };
  return {within(hit.u, domain.u), within(hit.v, domain.v)};
}

/// A unit vector as shaders/lib/octahedral.glsl has it.
Vec2f octahedral(const Vec3& n) {
  const double size = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
  if (!(size > 0)) return Vec2f(0);
  const Vec2 p(n.x / size, n.y / size);
  if (n.z >= 0) return Vec2f(p);
  return Vec2f(std::copysign(1 - std::abs(p.y), p.x), std::copysign(1 - std::abs(p.x), p.y));
}

}  // namespace

LayerRays::LayerRays(const reference::Caster& caster, const RayDraws& draws)
    : caster_(caster), draws_(draws) {
  const View& view = caster.snapshot().view;
  originDepth_ = glm::dot(draws.origin - view.eye, view.forward());
}

LayerRays::Seen LayerRays::look(const reference::Ray& ray, const Doubt& doubt) const {
  const reference::Caster::Sight sight = caster_.look(ray, reference::Caster::Invisible::Told);
  Seen seen{.certified = sight.certified};
  for (const reference::Hit& hit : sight.hits) {
    const auto node = std::ranges::lower_bound(draws_.layers, hit.node, {}, &FoundLayer::node);
    if (node == draws_.layers.end() || node->node != hit.node) continue;
    seen.found.push_back(lit(hit, {.material = node->material}, false, seen.certified));
  }
  seen.certified &= !doubt.layers || draws_.layerMeshes.empty() || doubt.meshes;
  if (!doubt.meshes) return seen;
  for (const shared::LayerPoint& point : *doubt.meshes) {
    const auto node =
        std::ranges::find(draws_.layerMeshes, point.material & shared::kLayerMaterial, &FoundLayer::material);
    const auto hit = node == draws_.layerMeshes.end() ? std::nullopt : ofMesh(point, node->node, ray, sight);
    seen.certified &= hit.has_value();
    if (hit) seen.ofMeshes.push_back(lit(*hit, point, true, seen.certified));
  }
  return seen;
}

LayerRays::LitPoint LayerRays::lit(const reference::Hit& hit, const shared::LayerPoint& point, bool ofMesh,
                                   bool& certified) const {
  LitPoint all{hit, point, {}};
  for (const LightGroup& group : draws_.groups)
    all.light.push_back(reachingLight(caster_, hit, group, certified, ofMesh));
  return all;
}

std::optional<reference::Hit> LayerRays::ofMesh(const shared::LayerPoint& point, std::uint32_t node,
                                                const reference::Ray& ray,
                                                const reference::Caster::Sight& sight) const {
  const View& view = caster_.snapshot().view;
  const SnapshotNode& of = caster_.snapshot().nodes[node];
  if (of.surface.isParametric()) return caster_.pointAt(node, Vec2(point.parameters), ray);
  const double depth = originDepth_ + point.depth, rounding = depthRounding(view, of);
  std::optional<reference::Hit> nearest;
  double least = kInfinity;
  for (const reference::Hit& hit : sight.hits) {
    const double off = std::abs(glm::dot(hit.position - view.eye, view.forward()) - depth);
    const double pixel = (view.perspective() ? depth : 1) / view.pixelsPerUnit;
    const double allowed = rounding + kPointPx * pixel / std::abs(glm::dot(hit.facet, ray.direction));
    if (hit.node != node || off > allowed || off >= least) continue;
    least = off;
    nearest = hit;
  }
  return nearest;
}

void LayerRays::appendRaysToLights(const Seen& seen, std::vector<reference::Ray>& rays) const {
  for (const std::vector<LitPoint>* points : {&seen.found, &seen.ofMeshes})
    for (const LitPoint& point : *points)
      for (const LightGroup& group : draws_.groups)
        for (const std::optional<std::uint32_t>& light : group.lights)
          if (light) rays.push_back({point.hit.position, caster_.towardLight(*light, point.hit)});
}

void LayerRays::append(const Seen& seen, PixelPlace pixel, RayPoints& points) const {
  points.layers.insert(points.layers.end(), 3,
                       {.place = Vec2f(pixel.x + 0.5, pixel.y + 0.5),
                        .first = static_cast<std::uint32_t>(points.layerPoints.size()),
                        .count = static_cast<std::uint32_t>(seen.found.size()),
                        .ofMeshes = static_cast<std::uint32_t>(seen.ofMeshes.size()),
                        .groups = static_cast<std::uint32_t>(draws_.groups.size()) |
                                  (seen.certified ? 0 : shared::kUndecidedLayers)});
  const auto add = [&](const shared::LayerPoint& told, const LitPoint& point) {
    points.layerPoints.push_back(told);
    points.layerLights.insert(points.layerLights.end(), point.light.begin(), point.light.end());
    points.layerDetails.push_back({.footprint = Vec4f(Vec4(point.hit.footprint[0], point.hit.footprint[1])),
                                   .frame = frameOf(caster_.snapshot().nodes[point.hit.node], point.hit)});
  };
  constexpr float kEnd = std::numeric_limits<float>::infinity();
  float last = -kEnd;
  for (const LitPoint& point : seen.found) {
    // Their order, which the ray knows, has to outlive the rounding of their depths.
    add(found(point, std::nextafter(last, kEnd)), point);
    last = points.layerPoints.back().depth;
  }
  for (const LitPoint& point : seen.ofMeshes) add(point.point, point);
  points.layersUndecided += !seen.certified;
}

shared::LayerPoint LayerRays::found(const LitPoint& point, float leastDepth) const {
  const reference::Hit& hit = point.hit;
  const View& view = caster_.snapshot().view;
  const Surface& surface = caster_.snapshot().nodes[hit.node].surface;
  const std::uint32_t hole = caster_.cutsOut(hit) ? shared::kLayerHole : 0;
  const auto depth = static_cast<float>(glm::dot(hit.position - draws_.origin, view.forward()));
  return {.depth = std::max(depth, leastDepth),
          .material = point.point.material | shared::kLayerByRay | hole,
          .normal = octahedral(hit.normal),
          .parameters = Vec2f(surface.isParametric() ? inside(surface.domain(), hit) : Vec2(hit.u, hit.v))};
}

}  // namespace luxo
