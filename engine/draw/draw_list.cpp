// SPDX-License-Identifier: Apache-2.0
#include "draw/draw_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "base/error.h"

namespace luxo {
namespace {

// Light that is interpolated between vertices needs vertices where light changes, also on flat surfaces. An
// outline is as wide as the slope of what is interpolated says, which long facets of a cone get wrong.
constexpr double kVertexSpacingPx = 12;

Vec3f toFloat(const Vec3& v) { return Vec3f(v); }

bool needsLights(const DrawState& state) {
  return state.output == Output::Color &&
         (state.shading == Shading::Flat || state.shading == Shading::Gouraud ||
          state.shading == Shading::Phong || state.shading == Shading::Exact ||
          state.shading == Shading::Toon);
}

MeshDesc meshDescOf(const SnapshotNode& node, const VisibleNode& visible, Shading shading, const View& view) {
  MeshDesc desc{.uniform = node.segments, .tolerance = visible.toleranceObject};
  if (shading == Shading::Gouraud || (shading == Shading::Toon && !node.surface.flatNormal()))
    desc.longestEdge = kVertexSpacingPx * (view.perspective() ? visible.nearestDepth : 1) /
                       (visible.stretch * visible.pixelsPerUnit);
  return desc;
}

/// How far the mesh of a shade may lie inside its true wall, metres. It does not depend on whether the shade
/// is seen, as what it lights may be.
double wallError(const Snapshot& snapshot, NodeId shade, double tolerancePx) {
  const auto node = std::find_if(snapshot.nodes.begin(), snapshot.nodes.end(),
                                 [&](const SnapshotNode& n) { return n.id == shade; });
  if (node == snapshot.nodes.end()) return 0;
  if (node->segments)
    return deviationBound(node->surface, node->parameters, *node->segments) *
           largestStretch(node->worldFromObject.linear);
  const View& view = snapshot.view;
  const Sphere sphere = sphereAround(node->boundsWorld);
  const double depth = glm::dot(sphere.center - view.eye, view.forward()) + sphere.radius;
  return tolerancePx * (view.perspective() ? std::max(depth, view.near) : 1) / view.pixelsPerUnit;
}

/// Collects the distinct sets of lights; equal sets share one entry.
class LightSets {
 public:
  LightSets(const Snapshot& snapshot, double tolerancePx, std::vector<shared::LightSet>& sets)
      : snapshot_(snapshot), tolerancePx_(tolerancePx), sets_(sets) {
    indexOf({});  // draws without light have a set to bind
  }

  struct Choice {
    std::uint32_t index = 0, plain = 0, shaded = 0;
    std::uint32_t shadeOf = 0;  ///< 1 + which of the shaded lights the node is the shade of; 0: none
  };

  Choice choose(std::span<const std::uint32_t> lights, const SnapshotNode& node) {
    if (lights.size() > shared::kMostLights)
      throw Error(ErrorKind::Scene,
                  fmt::format("{} lights reach one node (number {}); at most {} may", lights.size(),
                              node.number, shared::kMostLights),
                  "use fewer lights");
    std::vector<std::uint32_t> order(lights.begin(), lights.end());
    const auto firstShaded = std::stable_partition(order.begin(), order.end(), [&](std::uint32_t light) {
      return !snapshot_.lights[light].shade.has_value();
    });
    Choice choice;
    choice.plain = static_cast<std::uint32_t>(firstShaded - order.begin());
    choice.shaded = static_cast<std::uint32_t>(order.end() - firstShaded);
    for (std::uint32_t i = 0; i < choice.shaded; ++i)
      if (snapshot_.lights[order[choice.plain + i]].shade->caster == node.id) choice.shadeOf = i + 1;
    choice.index = indexOf(order);
    return choice;
  }

 private:
  std::uint32_t indexOf(const std::vector<std::uint32_t>& order) {
    const auto [entry, isNew] = known_.try_emplace(order, static_cast<std::uint32_t>(sets_.size()));
    if (isNew) sets_.push_back(build(order));
    return entry->second;
  }

  [[nodiscard]] shared::LightSet build(const std::vector<std::uint32_t>& order) const {
    shared::LightSet set{};
    std::size_t shade = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
      const SnapshotLight& light = snapshot_.lights[order[i]];
      const Vec3 position =
          light.directional() ? Vec3(light.positionWorld) : Vec3(light.positionWorld) - snapshot_.view.eye;
      set.lights[i] = {.position = Vec4f(toFloat(position), light.positionWorld.w),
                       .radiance = toFloat(light.radiance),
                       .inverseSquare = light.attenuation == Light::Attenuation::InverseSquare};
      if (light.shade) set.shades[shade++] = shadeData(*light.shade);
    }
    return set;
  }

  /// A point is inside the paraboloid if it is nearer to the focus than to the directrix plane, which is
  /// twice the focal length behind the focus. What protrudes between the true wall and its mesh is seen from
  /// outside and must not be lit from inside: the difference of the two distances grows by at most two per
  /// metre from the wall.
  [[nodiscard]] shared::ShadeData shadeData(const ShadeRule& rule) const {
    const double inside = 2 * rule.focalLength * rule.scale;
    return {.axis = toFloat(rule.axis),
            .cosRim = static_cast<float>(rule.cosRim),
            .reach = static_cast<float>(inside - 2 * wallError(snapshot_, rule.caster, tolerancePx_))};
  }

  const Snapshot& snapshot_;
  double tolerancePx_;
  std::vector<shared::LightSet>& sets_;
  std::map<std::vector<std::uint32_t>, std::uint32_t> known_;
};

bool ambientFollowsPattern(const Material& material) {
  return material.diffusePattern.valid() && !material.ambient;
}

std::uint32_t flagsOf(const SnapshotNode& node, const VisibleNode& visible, const Material& material,
                      std::uint32_t shadeOf) {
  return (visible.twoSided ? shared::kTwoSided : 0) |
         (material.lectureSpecular ? shared::kLectureSpecular : 0) |
         (ambientFollowsPattern(material) ? shared::kPatternAmbient : 0) |
         (node.surface.flatNormal() ? shared::kPlane : 0) | shadeOf << shared::kShadeShift;
}

shared::InstanceData instanceOf(const Snapshot& snapshot, const SnapshotNode& node,
                                const VisibleNode& visible, const Mesh& mesh, std::uint32_t shadeOf) {
  const Material& material = snapshot.materials[node.material.index];
  const Domain& domain = node.surface.domain();
  const Mat3 normals = normalMatrix(node.worldFromObject.linear);
  double largest = 0;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) largest = std::max(largest, std::abs(normals[column][row]));
  return {
      .relativeFromObject = Mat3f(node.worldFromObject.linear),
      .translation = toFloat(transformPoint(node.worldFromObject, mesh.origin) - snapshot.view.eye),
      .normalFromObject = Mat3f(largest > 0 ? normals / largest : normals),
      .ambient = toFloat(ambientFollowsPattern(material) ? snapshot.ambient
                                                         : material.ambientOrDiffuse() * snapshot.ambient),
      .diffuse = toFloat(material.diffuse),
      .specular = toFloat(material.specular),
      .shininess = static_cast<float>(material.shininess),
      .opacity = static_cast<float>(material.opacity),
      .flags = flagsOf(node, visible, material, shadeOf),
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
  return {.clipFromRelative = Mat4f(view.clipFromEye * eyeFromRelative),
          .viewer = view.perspective() ? Vec4f(0, 0, 0, 1) : Vec4f(toFloat(-view.forward()), 0),
          .forward = toFloat(view.forward()),
          .depthRange = Vec2f(std::min(nearest, farthest), farthest)};
}

FaceCulling cullingOf(const VisibleNode& visible, const DrawOptions& options) {
  return visible.hideBackFaces && options.cullBackFaces ? FaceCulling::Back : FaceCulling::None;
}

/// Turns visible nodes into draws.
class DrawLister {
 public:
  DrawLister(const Snapshot& snapshot, const VisibleList& visible, const DrawOptions& options,
             MeshCache& meshes)
      : snapshot_(snapshot),
        visible_(visible),
        options_(options),
        meshes_(meshes),
        lightSets_(snapshot, options.tolerancePx, list_.lightSets) {
    list_.view = viewData(snapshot, visible);
  }

  DrawList list() && {
    listOpaque();
    listTransparent();
    return std::move(list_);
  }

 private:
  /// A draw of one node, and its instance.
  struct Item {
    DrawBatch batch;
    shared::InstanceData instance;
  };

  /// Every node joins the first draw of its kind, so that draws stay roughly front to back.
  void listOpaque() {
    struct Group {
      DrawBatch batch;
      std::vector<shared::InstanceData> instances;
    };
    std::vector<Group> groups;
    std::map<std::tuple<DrawState, const Mesh*, FaceCulling, bool, std::uint32_t>, std::size_t> groupOf;
    for (const VisibleNode& v : visible_.opaque) {
      Item item = itemOf(v, false);
      const DrawBatch& b = item.batch;
      const auto [entry, isNew] =
          groupOf.try_emplace({b.state, b.mesh.get(), b.culling, b.mirrored, b.lightSet}, groups.size());
      if (isNew) groups.push_back({std::move(item.batch), {}});
      groups[entry->second].instances.push_back(item.instance);
    }
    for (Group& group : groups)
      append(list_.opaque, std::move(group.batch), group.instances, {Half::Near, Half::Far});
  }

  /// Order is everything, so only neighbours merge, and a surface shows its far side first.
  void listTransparent() {
    const auto sameDraw = [](const DrawBatch& a, const DrawBatch& b) {
      return a.state == b.state && a.mesh == b.mesh && a.culling == b.culling && a.mirrored == b.mirrored &&
             a.lightSet == b.lightSet;
    };
    for (const VisibleNode& v : visible_.transparent) {
      Item item = itemOf(v, true);
      if (!list_.transparent.empty() && sameDraw(list_.transparent.back(), item.batch)) {
        list_.instances.push_back(item.instance);
        ++list_.transparent.back().instanceCount;
      } else {
        append(list_.transparent, std::move(item.batch), {&item.instance, 1}, {Half::Far, Half::Near});
      }
    }
  }

  Item itemOf(const VisibleNode& v, bool blended) {
    const SnapshotNode& node = snapshot_.nodes[v.node];
    const Material& material = snapshot_.materials[node.material.index];
    const Shading shading = material.shadingIn(options_.shading);
    Item item;
    DrawBatch& batch = item.batch;
    batch.state = {.shading = shading, .output = options_.output, .blended = blended};
    batch.mesh = meshes_.get(node.surface, node.parameters, meshDescOf(node, v, shading, snapshot_.view));
    batch.culling = cullingOf(v, options_);
    batch.flat = node.surface.flatNormal().has_value();
    batch.twoSided = v.twoSided;
    batch.mirrored = v.mirrored;
    LightSets::Choice lights;
    if (needsLights(batch.state)) {
      lights = lightSets_.choose(std::span(visible_.lights).subspan(v.firstLight, v.lightCount), node);
      batch.state.pattern = material.diffusePattern;
    }
    batch.lightSet = lights.index;
    batch.state.plainLights = lights.plain;
    batch.state.shadedLights = lights.shaded;
    item.instance = instanceOf(snapshot_, node, v, *batch.mesh, lights.shadeOf);
    if (batch.state.pattern.valid())
      item.instance.firstPatternParameter = patternParametersOf(node.material.index);
    list_.boundPx = std::max(list_.boundPx, boundPx(snapshot_.view, v, batch.mesh->bound));
    return item;
  }

  /// Where the parameters of a material's pattern start; listed when first asked for.
  std::uint32_t patternParametersOf(std::uint32_t material) {
    std::vector<float>& all = list_.patternParameters;
    const auto [entry, isNew] =
        firstParameterOf_.try_emplace(material, static_cast<std::uint32_t>(all.size()));
    if (isNew) {
      const auto& parameters = snapshot_.materials[material].patternParameters;
      all.insert(all.end(), parameters.begin(), parameters.end());
      if (all.empty()) all.push_back(0);  // something to bind
    }
    return entry->second;
  }

  /// Adds a draw of these instances; of a curved surface that shows both sides two, in the given order.
  void append(std::vector<DrawBatch>& batches, DrawBatch batch,
              std::span<const shared::InstanceData> instances, std::array<Half, 2> halves) {
    if (batch.mesh->indices.empty()) return;  // a formula without a single finite triangle
    batch.firstInstance = static_cast<std::uint32_t>(list_.instances.size());
    batch.instanceCount = static_cast<std::uint32_t>(instances.size());
    list_.instances.insert(list_.instances.end(), instances.begin(), instances.end());
    const bool bothSides =
        batch.culling == FaceCulling::None && !batch.flat && batch.state.shading != Shading::Wireframe;
    if (!bothSides) {
      batches.push_back(std::move(batch));
      return;
    }
    for (const Half half : halves) {
      batch.half = half;
      batch.culling = half == Half::Near ? FaceCulling::Back : FaceCulling::Front;
      batches.push_back(batch);
    }
  }

  const Snapshot& snapshot_;
  const VisibleList& visible_;
  const DrawOptions& options_;
  MeshCache& meshes_;
  DrawList list_;
  LightSets lightSets_;
  std::map<std::uint32_t, std::uint32_t> firstParameterOf_;
};

}  // namespace

DrawList listDraws(const Snapshot& snapshot, const VisibleList& visible, const DrawOptions& options,
                   MeshCache& meshes) {
  return DrawLister(snapshot, visible, options, meshes).list();
}

}  // namespace luxo
