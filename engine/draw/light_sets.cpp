// SPDX-License-Identifier: Apache-2.0
#include "draw/light_sets.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "base/error.h"
#include "draw/draw_list.h"
#include "draw/shadow_list.h"
#include "math/transform.h"
#include "tessellate/tessellator.h"

namespace luxo {
namespace {

/// How far what is drawn of a shade may lie inside its true wall, metres: its mesh; a shade that is found in
/// every pixel is the true wall. It does not depend on whether the shade is seen, as what it lights may be.
double wallError(const Snapshot& snapshot, NodeId shade, const DrawOptions& options) {
  const auto node = std::find_if(snapshot.nodes.begin(), snapshot.nodes.end(),
                                 [&](const SnapshotNode& n) { return n.id == shade; });
  if (node == snapshot.nodes.end() || findsSurface(snapshot, *node, options)) return 0;
  if (node->segments)
    return deviationBound(node->surface, node->parameters, *node->segments) *
           largestStretch(node->worldFromObject.linear);
  const View& view = snapshot.view;
  const Sphere sphere = sphereAround(node->boundsWorld);
  const double depth = glm::dot(sphere.center - view.eye, view.forward()) + sphere.radius;
  return options.tolerancePx * (view.perspective() ? std::max(depth, view.near) : 1) / view.pixelsPerUnit;
}

/// Metres: what is farther away is a direction, as floats have no room for its square.
constexpr double kFarthest = 1e18;

bool isDirection(const SnapshotLight& light, const Vec3& origin) {
  return light.directional() || !(glm::length(light.from(origin)) <= kFarthest);
}

/// One that is so far away that it is a direction lights everything as its cone has it at the origin.
bool isSpot(const SnapshotLight& light, const Vec3& origin) {
  return light.cone && !isDirection(light, origin);
}

shared::LightData lightData(const SnapshotLight& light, const Vec3& origin) {
  const bool fades = light.attenuation == Light::Attenuation::InverseSquare;
  const Vec3 toLight = light.from(origin);
  const double distance = glm::length(toLight);
  if (light.directional() || !isDirection(light, origin))
    return {.position = Vec4f(Vec3f(toLight), light.positionWorld.w),
            .radiance = Vec3f(light.radiance),
            .inverseSquare = fades};
  return {.position = Vec4f(Vec3f(toLight / distance), 0),
          .radiance =
              Vec3f(light.coneTo(origin) * (fades ? light.radiance / distance / distance : light.radiance)),
          .inverseSquare = false};
}

shared::SpotData spotData(const SnapshotLight& light, const Vec3& origin) {
  const SpotCone& cone = *light.cone;
  const Vec3 toLight = light.from(origin);
  return {.axis = Vec3f(cone.axis),
          .through = Vec3f(toLight - glm::dot(toLight, cone.axis) * cone.axis),
          .rise = static_cast<float>(cone.rise()),
          .perPenumbra = static_cast<float>(1 / cone.penumbra())};
}

/// Of a light's node among those that have lights.
std::uint32_t orderOf(const Snapshot& snapshot, NodeId node) {
  std::set<std::uint32_t> before;
  for (const SnapshotLight& light : snapshot.lights)
    if (light.id.index < node.index) before.insert(light.id.index);
  return static_cast<std::uint32_t>(before.size());
}

}  // namespace

LightSets::LightSets(const Snapshot& snapshot, const DrawOptions& options, const Vec3& origin,
                     std::vector<shared::LightSet>& sets)
    : snapshot_(snapshot),
      options_(options),
      closedForms_(hasClosedForms(snapshot, options)),
      origin_(origin),
      sets_(sets) {
  indexOf({});
}

LightSets::Choice LightSets::choose(std::span<const std::uint32_t> lights, const SnapshotNode& node) {
  if (lights.size() > shared::kMaxLights)
    throw Error(ErrorKind::Scene,
                fmt::format("{} lights reach one node (number {}); at most {} may", lights.size(),
                            node.number, shared::kMaxLights),
                "use fewer lights");
  std::vector<std::uint32_t> order(lights.begin(), lights.end());
  const auto firstShaded = std::stable_partition(
      order.begin(), order.end(), [&](std::uint32_t light) { return !isShaded(snapshot_.lights[light]); });
  Choice choice;
  choice.plain = static_cast<std::uint32_t>(firstShaded - order.begin());
  choice.shaded = static_cast<std::uint32_t>(order.end() - firstShaded);
  choice.shadeOf = numberOf(node.id, std::span(order).subspan(choice.plain));
  for (std::size_t i = 0; i < order.size(); ++i)
    if (isSpot(snapshot_.lights[order[i]], origin_)) choice.spots |= 1U << i;
  choice.index = indexOf(order);
  choice.lights = std::move(order);
  return choice;
}

std::uint32_t LightSets::indexOf(const std::vector<std::uint32_t>& order) {
  const auto [entry, isNew] = known_.try_emplace(order, static_cast<std::uint32_t>(sets_.size()));
  if (isNew) sets_.push_back(build(order));
  return entry->second;
}

shared::LightSet LightSets::build(const std::vector<std::uint32_t>& order) const {
  shared::LightSet set{};
  std::vector<std::uint32_t> shaded;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const SnapshotLight& light = snapshot_.lights[order[i]];
    set.lights[i] = lightData(light, origin_);
    set.order[i] = orderOf(snapshot_, light.id);
    if (isSpot(light, origin_)) set.spots[i] = spotData(light, origin_);
    if (isShaded(light)) shaded.push_back(order[i]);
  }
  for (std::size_t i = 0; i < shaded.size(); ++i) {
    const ShadeRule& rule = *snapshot_.lights[shaded[i]].shade;
    set.shades[i] = shadeData(rule);
    set.shades[i].number = numberOf(rule.caster, shaded);
  }
  return set;
}

/// A point is inside the paraboloid if it is nearer to the focus than to the directrix plane, which is
/// twice the focal length behind the focus. What protrudes between the true wall and its mesh is seen from
/// outside and must not be lit from inside: the difference of the two distances grows by at most two per
/// metre from the wall.
shared::ShadeData LightSets::shadeData(const ShadeRule& rule) const {
  const double inside = 2 * rule.focalLength;
  return {.axis = Vec3f(rule.axis),
          .cosRim = static_cast<float>(rule.cosRim),
          .reach = static_cast<float>(inside - 2 * wallError(snapshot_, rule.caster, options_)),
          .number = 0};
}

std::uint32_t LightSets::numberOf(NodeId caster, std::span<const std::uint32_t> shaded) const {
  const auto first = std::ranges::find(
      shaded, caster, [this](std::uint32_t light) { return snapshot_.lights[light].shade->caster; });
  return first == shaded.end() ? 0 : static_cast<std::uint32_t>(first - shaded.begin()) + 1;
}

}  // namespace luxo
