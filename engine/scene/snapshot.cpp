// SPDX-License-Identifier: Apache-2.0
#include "scene/snapshot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "base/assert.h"
#include "base/error.h"
#include "math/sampling.h"
#include "scene/fitted_camera.h"
#include "scene/vertex_movement.h"
#include "surface/cloth_simulation.h"
#include "surface/surface_triangles.h"

namespace luxo {

namespace {

/// The light must sit in the focus to this part of the shade's size: rounding down a deep hierarchy, not a
/// millimetre.
constexpr double kFocusTolerance = 1e-9;

bool finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// A node at a moment, and what messages call it.
struct NodeThen {
  const Scene& scene;
  NodeId id;
  const Moment& moment;

  [[nodiscard]] const Node& node() const { return scene[id]; }
  [[noreturn]] void reject(const std::string& what, std::string hint = {}) const {
    throw Error(ErrorKind::Scene,
                fmt::format("node {} at time {}: {}", scene.shownName(id), moment.time, what),
                std::move(hint));
  }
};

Vec3 finiteAt(const NodeThen& then, std::string_view name, const Animated<Vec3>& value) {
  const Vec3 v = value.at(then.moment);
  if (!finite(v)) then.reject(fmt::format("{} is ({}, {}, {}); it must be finite", name, v.x, v.y, v.z));
  return v;
}

Mat3 rotationAt(const NodeThen& then) {
  const auto [axis, angle] = then.node().rotation.at(then.moment);
  if (!finite(axis) || !std::isfinite(angle))
    then.reject(
        fmt::format("rotation by {} about ({}, {}, {}) is not finite", angle, axis.x, axis.y, axis.z));
  if (axis == Vec3(0) && angle != 0)
    then.reject(fmt::format("rotation by {} rad about a zero axis", angle), "give an axis that is not zero");
  return rotation(axis, angle);
}

Transform parentFromNode(const NodeThen& then) {
  const Node& node = then.node();
  return compose(finiteAt(then, "translation", node.translation), rotationAt(then),
                 finiteAt(then, "scale", node.scale));
}

/// Every node of the scene at one moment; index = NodeId.
struct Placed {
  Transform worldFromNode;
  bool visible = false;
};

std::vector<Placed> placeNodes(const Scene& scene, const Moment& moment) {
  std::vector<Placed> placed(scene.nodes().size());
  for (std::uint32_t i = 0; i < placed.size(); ++i) {
    const auto& [node, removed, bounds] = scene.nodes()[i];
    if (removed || !node.visible.at(moment)) continue;
    const Placed* parent = node.parent.valid() ? &placed[node.parent.index] : nullptr;
    if (parent && !parent->visible) continue;
    const NodeThen then{scene, {i}, moment};
    const Transform local = parentFromNode(then);
    placed[i] = {parent ? parent->worldFromNode * local : local, true};
    const Transform& t = placed[i].worldFromNode;
    if (!finite(t.translation) || !finite(t.linear[0]) || !finite(t.linear[1]) || !finite(t.linear[2]))
      then.reject("its place in the world is not finite", "scales or translations above it are too large");
  }
  return placed;
}

/// Numbers from 1 in depth-first order: a node's number is its parent's plus the sizes of what comes in
/// between.
std::vector<std::uint32_t> numberNodes(const Scene& scene) {
  const auto& nodes = scene.nodes();
  std::vector<std::uint32_t> subtree(nodes.size()), number(nodes.size()), next(nodes.size());
  for (std::size_t i = nodes.size(); i-- > 0;) {
    if (nodes[i].removed) continue;
    subtree[i] += 1;
    if (nodes[i].node.parent.valid()) subtree[nodes[i].node.parent.index] += subtree[i];
  }
  std::uint32_t nextRoot = 1;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].removed) continue;
    std::uint32_t& free = nodes[i].node.parent.valid() ? next[nodes[i].node.parent.index] : nextRoot;
    number[i] = free;
    next[i] = free + 1;
    free += subtree[i];
  }
  return number;
}

/// What a cloth is like then.
Surface clothThen(const NodeThen& then, const Cloth& built, std::span<const double> numbers) {
  try {
    const Cloth cloth = withNumbers(built, numbers);
    return then.scene.clothSimulation()->surfaceAfter(cloth, clothSteps(cloth, then.moment.time));
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::Scene) throw;
    then.reject(error.what(), error.hint());
  }
}

SnapshotNode takeNode(const NodeThen& then) {
  const Scene::Entry& entry = then.scene.nodes()[then.id.index];
  const Node& node = entry.node;
  SnapshotNode taken{.surface = node.surface, .material = node.material, .segments = node.segments};
  for (const Animated<double>& parameter : node.surface.parameters()) {
    taken.parameters.push_back(parameter.at(then.moment));
    if (!std::isfinite(taken.parameters.back()))
      then.reject(fmt::format("parameter {} of its surface '{}' is {}; it must be finite",
                              taken.parameters.size(), node.surface.name(), taken.parameters.back()));
  }
  if (const SurfaceTriangles* triangles = node.surface.triangles(); triangles && triangles->cloth) {
    taken.surface = clothThen(then, *triangles->cloth, std::exchange(taken.parameters, {}));
    taken.boundsObject = taken.surface.bounds({});
    return taken;
  }
  taken.boundsObject = entry.constantBounds ? *entry.constantBounds : node.surface.bounds(taken.parameters);
  return taken;
}

std::vector<SnapshotNode> takeNodes(const Scene& scene, const std::vector<Placed>& placed,
                                    const Moment& moment) {
  const std::vector<std::uint32_t> numbers = numberNodes(scene);
  std::vector<SnapshotNode> nodes;
  for (std::uint32_t i = 0; i < placed.size(); ++i) {
    const Scene::Entry& entry = scene.nodes()[i];
    if (!placed[i].visible || !entry.node.surface.valid()) continue;
    SnapshotNode node = takeNode({scene, {i}, moment});
    node.id = {i};
    node.number = numbers[i];
    node.worldFromObject = placed[i].worldFromNode;
    node.boundsWorld = transformBounds(node.worldFromObject, node.boundsObject);
    nodes.push_back(std::move(node));
  }
  return nodes;
}

/// What casts the light's shadow at this moment: only what is visible does.
std::vector<NodeId> visibleCasters(const Light& light, const Scene& scene,
                                   const std::vector<Placed>& placed) {
  std::vector<NodeId> casters;
  const auto consider = [&](NodeId id) {
    if (placed[id.index].visible && scene[id].surface.valid()) casters.push_back(id);
  };
  for (std::uint32_t i = 0; light.casters.empty() && i < placed.size(); ++i) consider({i});
  std::ranges::for_each(light.casters, consider);
  return casters;
}

/// Who casts the shadow of the node's light, ascending; none if it has no shadow.
std::vector<NodeId> castersOf(const NodeThen& then, const std::vector<Placed>& placed) {
  const Light& light = *then.node().light;
  if (light.shadow == Light::Shadow::None) return {};
  std::vector<NodeId> casters = visibleCasters(light, then.scene, placed);
  std::ranges::sort(casters, {}, &NodeId::index);
  casters.erase(std::unique(casters.begin(), casters.end()), casters.end());
  return casters;
}

/// What the planar shadow of the node's light falls on; nothing of other shadows.
std::optional<NodeId> planeOf(const NodeThen& then) {
  const Light& light = *then.node().light;
  if (light.shadow != Light::Shadow::Planar) return std::nullopt;
  constexpr const char* kHint =
      "its \"shadow_plane\" is a rectangle, a disk, or another surface in one plane";
  if (!light.shadowPlane.valid()) then.reject("its light's planar shadow has no plane to fall on", kHint);
  const Surface& surface = then.scene[light.shadowPlane].surface;
  if (!surface.valid() || !surface.flatNormal())
    then.reject(fmt::format("its light's planar shadow cannot fall on node {}, which is not flat",
                            then.scene.shownName(light.shadowPlane)),
                kHint);
  return light.shadowPlane;
}

/// By content, so that the order in which the scene was put together leaves no trace. What rarely changes
/// with time comes first. Shaded lights last, and of either kind spots: which of a draw's lights are spots
/// decides its program (DrawState::spots), and no order that changes as they move must change it.
bool precedes(const SnapshotLight& a, const SnapshotLight& b) {
  const auto key = [](const SnapshotLight& l) {
    const SpotCone cone = l.cone.value_or(SpotCone());
    return std::tuple(l.shade.has_value(), l.cone.has_value(), l.casters.size(), l.attenuation, l.radiance.x,
                      l.radiance.y, l.radiance.z, l.positionWorld.w, l.positionWorld.x, l.positionWorld.y,
                      l.positionWorld.z, cone.inner, cone.outer, cone.axis.x, cone.axis.y, cone.axis.z);
  };
  return key(a) < key(b);
}

/// Axes of the disc that a directional light is seen as: the node's, as far as they are across its direction.
Mat3 discAxes(const Transform& worldFromNode, const Vec3& towardLight) {
  const auto across = [&](const Vec3& axis) { return axis - glm::dot(axis, towardLight) * towardLight; };
  Vec3 x = unit(across(unit(transformDirection(worldFromNode, Vec3(1, 0, 0)))));
  if (x == Vec3(0)) x = unit(across(std::abs(towardLight.x) < 0.5 ? Vec3(1, 0, 0) : Vec3(0, 1, 0)));
  return {x, glm::cross(towardLight, x), towardLight};
}

/// The points that stand for a light of this radius; the light itself where it has none.
std::vector<SnapshotLight> sampledLight(const SnapshotLight& light, const Transform& worldFromNode,
                                        double radius, std::uint32_t samples) {
  if (radius == 0) return {light};
  std::vector<SnapshotLight> sampled(samples, light);
  const Mat3 axes = light.directional() ? discAxes(worldFromNode, Vec3(light.positionWorld)) : Mat3(1);
  for (std::uint32_t k = 0; k < samples; ++k) {
    SnapshotLight& one = sampled[k];
    one.radiance /= samples;
    one.positionWorld = light.directional()
                            ? Vec4(axes * capPoint(k, samples, radius), 0)
                            : Vec4(Vec3(light.positionWorld) + radius * luminousBallPoint(k, samples), 1);
  }
  return sampled;
}

/// The node's +Z, where the light of a directional one comes from.
Vec3 backwardOf(const NodeThen& then, const Transform& worldFromNode) {
  const Vec3 backward = unit(transformDirection(worldFromNode, Vec3(0, 0, 1)));
  if (backward == Vec3(0)) then.reject("its light has no direction: the scale along z is zero");
  return backward;
}

std::vector<SnapshotLight> takeLights(const Scene& scene, const std::vector<Placed>& placed,
                                      const Moment& moment, std::uint32_t mostShadowSamples,
                                      std::uint32_t& cutNumbers) {
  std::vector<SnapshotLight> lights;
  for (std::uint32_t i = 0; i < placed.size(); ++i) {
    const NodeThen then{scene, {i}, moment};
    const Node& node = scene.nodes()[i].node;
    if (!placed[i].visible || !node.light) continue;
    const auto nodeName = [&] { return scene.shownName({i}); };
    SnapshotLight light{.id = {i},
                        .positionWorld = Vec4(placed[i].worldFromNode.translation, 1),
                        .radiance = radianceAt(*node.light, moment, nodeName, &cutNumbers),
                        .attenuation = node.light->attenuation};
    if (node.light->type == Light::Type::Directional) {
      const Vec3 towardLight = backwardOf(then, placed[i].worldFromNode);
      light.positionWorld = Vec4(towardLight, 0);
    } else if (node.light->spot) {
      light.cone = spotConeAt(*node.light, -backwardOf(then, placed[i].worldFromNode), moment, nodeName);
    }
    light.casters = castersOf(then, placed);
    light.plane = planeOf(then);
    const std::uint32_t samples = std::min(node.light->shadowSamples, mostShadowSamples);
    if (node.light->shadow == Light::Shadow::Map && light.hasShadow()) {
      light.map = shadowMapAt(*node.light, moment, nodeName);
      light.samples = light.map->radius > 0 ? samples : 1;
      lights.push_back(std::move(light));
      continue;
    }
    const double radius = light.hasShadow() ? radiusAt(*node.light, moment, nodeName) : 0;
    for (SnapshotLight& one : sampledLight(light, placed[i].worldFromNode, radius, samples))
      lights.push_back(std::move(one));
  }
  return lights;
}

std::vector<Material> takeMaterials(const Scene& scene, const Moment& moment, std::uint32_t& cutNumbers) {
  std::vector<Material> materials;
  materials.reserve(scene.materials().size());
  for (const Animated<Material>& material : scene.materials()) {
    materials.push_back(material.at(moment));
    if (material.isConstant()) continue;
    cutNumbers += cutToRange(materials.back());
    validate(materials.back());
  }
  return materials;
}

/// Lights stay so far below float's range that what colours reflect of them is within it.
void cutLights(Snapshot& snapshot) {
  double brightest = 1;
  for (const Material& material : snapshot.materials)
    for (const Vec3& color : {material.diffuse, material.specular})
      brightest = std::max({brightest, color.x, color.y, color.z});
  for (SnapshotLight& light : snapshot.lights)
    snapshot.cutNumbers += cutToRange(light.radiance, kMaxReflected / brightest);
}

/// Triangles are where their materials' vertex programs move them.
void moveVertices(const Scene& scene, Snapshot& snapshot) {
  for (SnapshotNode& node : snapshot.nodes) {
    const Material& material = snapshot.materials[node.material.index];
    if (!node.surface.isPolygonal() || !material.movesVertices()) continue;
    node.surface = scene.vertexMovement()->moved(node.surface, material);
    node.boundsObject = node.surface.bounds({});
    node.boundsWorld = transformBounds(node.worldFromObject, node.boundsObject);
  }
}

/// A planar shadow falls on what hides all else.
void requirePlanarShadows(const Scene& scene, const Snapshot& snapshot, const Moment& moment) {
  for (const SnapshotLight& light : snapshot.lights) {
    if (!light.plane) continue;
    const auto plane = std::ranges::find(snapshot.nodes, *light.plane, &SnapshotNode::id);
    if (plane == snapshot.nodes.end()) continue;
    if (!plane->surface.flatNormal())
      NodeThen{scene, plane->id, moment}.reject(
          "its vertex program moves it, and it is not flat any more, as what a planar shadow falls on is",
          "set the light's shadow to \"exact\"");
    if (snapshot.materials[plane->material.index].transparent())
      NodeThen{scene, plane->id, moment}.reject(
          "it is seen through, and the plane of a planar shadow, which is not supported",
          "set its material's opacity to 1, or the light's shadow to \"exact\"");
  }
}

/// What a map shows of a wide light is of all of it; what glass lets through is of each of its points.
void spreadOverGlass(Snapshot& snapshot) {
  const auto isGlass = [&](NodeId id) {
    const auto node = std::ranges::find(snapshot.nodes, id, &SnapshotNode::id);
    return node != snapshot.nodes.end() && snapshot.materials[node->material.index].letsLightThrough();
  };
  std::vector<SnapshotLight> lights;
  for (SnapshotLight light : std::move(snapshot.lights)) {
    if (light.samples == 1 || std::ranges::none_of(light.casters, isGlass)) {
      lights.push_back(std::move(light));
      continue;
    }
    light.pointOf = WidePlace{light.positionWorld, light.map->radius};
    const std::uint32_t samples = std::exchange(light.samples, 1U);
    for (SnapshotLight& one : sampledLight(light, Transform(), light.map->radius, samples))
      lights.push_back(std::move(one));
  }
  snapshot.lights = std::move(lights);
}

/// The closed form of an exact shadow: one opaque paraboloid casts it, and the light sits in its focus.
std::optional<ShadeRule> closedForm(const SnapshotLight& light, const Snapshot& snapshot) {
  if (light.approximate() || light.directional() || light.casters.size() != 1) return std::nullopt;
  const NodeId id = light.casters[0];
  const auto caster = std::ranges::lower_bound(snapshot.nodes, id.index, {},
                                               [](const SnapshotNode& node) { return node.id.index; });
  if (caster == snapshot.nodes.end() || caster->id != id ||
      snapshot.materials[caster->material.index].letsLightThrough())
    return std::nullopt;
  const std::optional<Paraboloid> paraboloid = caster->surface.paraboloid();
  if (!paraboloid) return std::nullopt;
  std::optional<ShadeRule> rule = shadeRule(*paraboloid, caster->worldFromObject, caster->id);
  if (rule && !(glm::length(Vec3(light.positionWorld) - rule->focus) <=
                kFocusTolerance * (rule->focalLength + rule->height)))
    rule.reset();
  return rule;
}

/// Everything but the view.
Snapshot takeUnseen(const Scene& scene, const Moment& moment, std::uint32_t mostShadowSamples) {
  const std::vector<Placed> placed = placeNodes(scene, moment);
  Snapshot snapshot{.nodes = takeNodes(scene, placed, moment),
                    .background = scene.settings().background,
                    .ambient = scene.settings().ambient,
                    .blendOrder = scene.settings().blendOrder,
                    .ambientOcclusion = scene.settings().ambientOcclusion};
  snapshot.lights = takeLights(scene, placed, moment, mostShadowSamples, snapshot.cutNumbers);
  snapshot.materials = takeMaterials(scene, moment, snapshot.cutNumbers);
  moveVertices(scene, snapshot);
  cutLights(snapshot);
  spreadOverGlass(snapshot);
  for (SnapshotLight& light : snapshot.lights) light.shade = closedForm(light, snapshot);
  std::ranges::sort(snapshot.lights, precedes);
  requirePlanarShadows(scene, snapshot, moment);
  return snapshot;
}

/// A scene at one time, with what a Moment of it refers to.
struct Instant {
  Instant(const Scene& pictured, double timeSeconds, std::uint32_t mostShadowSamples)
      : scene(pictured), time(timeSeconds), shadowSamples(mostShadowSamples) {
    if (!std::isfinite(time))
      throw Error(ErrorKind::Scene, fmt::format("cannot picture the scene at time {}", time));
    parameters = scene.parametersAt(time);
  }

  [[nodiscard]] Moment moment() const { return {time, parameters}; }
  [[nodiscard]] Snapshot unseen() const { return takeUnseen(scene, moment(), shadowSamples); }
  [[nodiscard]] Snapshot seen(Snapshot snapshot, const Camera& camera, PixelSize size) const {
    snapshot.view = viewAt(camera, moment(), size, framingOf(snapshot));
    return snapshot;
  }

  const Scene& scene;
  double time;
  std::uint32_t shadowSamples;
  std::vector<double> parameters;
};

}  // namespace

bool operator==(const SnapshotNode& a, const SnapshotNode& b) {
  return a.id == b.id && a.number == b.number && a.surface.identity() == b.surface.identity() &&
         a.material == b.material && a.segments == b.segments && a.worldFromObject == b.worldFromObject &&
         a.parameters == b.parameters;
}

Snapshot takeSnapshot(const Scene& scene, double timeSeconds, PixelSize size, const Camera& camera,
                      std::uint32_t mostShadowSamples) {
  const Instant now(scene, timeSeconds, mostShadowSamples);
  return now.seen(now.unseen(), camera, size);
}

Snapshot takeSnapshot(const Scene& scene, double timeSeconds, PixelSize size, CameraId camera,
                      std::uint32_t mostShadowSamples) {
  const Instant now(scene, timeSeconds, mostShadowSamples);
  Snapshot snapshot = now.unseen();
  if (camera.valid() || !scene.cameras().empty())
    return now.seen(std::move(snapshot), scene[camera.valid() ? camera : CameraId{0}], size);
  const double fitTime = scene.settings().time;
  const bool sameMoment = timeSeconds == fitTime || !scene.movesWithTime();
  const Camera fitted = fitCamera(sameMoment ? snapshot : Instant(scene, fitTime, 1).unseen(), size);
  return now.seen(std::move(snapshot), fitted, size);
}

Snapshot withExactShadows(Snapshot snapshot) {
  for (SnapshotLight& light : snapshot.lights) light.plane.reset();
  return withoutShadowMaps(std::move(snapshot));
}

Snapshot withoutShadowMaps(Snapshot snapshot) {
  std::vector<SnapshotLight> lights;
  for (SnapshotLight light : std::move(snapshot.lights)) {
    const double radius = light.map && !light.pointOf ? light.map->radius : 0;
    light.map.reset();
    const std::uint32_t samples = std::exchange(light.samples, 1U);
    if (radius > 0) light.pointOf = WidePlace{light.positionWorld, radius};
    for (SnapshotLight& one : sampledLight(light, Transform(), radius, samples))
      lights.push_back(std::move(one));
  }
  snapshot.lights = std::move(lights);
  std::ranges::sort(snapshot.lights, precedes);
  return snapshot;
}

std::vector<WholeLight> wholeLights(const Snapshot& snapshot) {
  std::vector<WholeLight> wholes;
  std::map<std::uint32_t, std::size_t> known;  // of nodes whose lights are points: of wholes
  for (std::uint32_t i = 0; i < snapshot.lights.size(); ++i) {
    const SnapshotLight& light = snapshot.lights[i];
    if (!light.pointOf) {
      wholes.push_back({light, i});
      continue;
    }
    const auto [whole, isNew] = known.try_emplace(light.id.index, wholes.size());
    if (!isNew) {
      wholes[whole->second].light.radiance += light.radiance;
      continue;
    }
    wholes.push_back({light, std::nullopt, light.pointOf->radius});
    wholes.back().light.positionWorld = light.pointOf->middle;
    wholes.back().light.pointOf.reset();
  }
  return wholes;
}

std::size_t approximateShadows(const Snapshot& snapshot) {
  std::set<NodeId> lights;  // one may be several points
  for (const SnapshotLight& light : snapshot.lights)
    if (light.approximate()) lights.insert(light.id);
  return lights.size();
}

Box framingOf(const Snapshot& snapshot) {
  Box box;
  for (const SnapshotNode& node : snapshot.nodes) {
    if (std::isfinite(glm::dot(node.boundsWorld.extent(), Vec3(1)))) {
      box.add(node.boundsWorld);
    } else if (const Box framing = node.surface.framing(node.parameters); !framing.empty()) {
      box.add(transformBounds(node.worldFromObject, framing));
    }
  }
  return box;
}

}  // namespace luxo
