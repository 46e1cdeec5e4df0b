// SPDX-License-Identifier: Apache-2.0
#include "draw/material_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>

#include "base/error.h"
#include "draw/material_program.h"
#include "draw/place_list.h"
#include "draw/shadow_list.h"
#include "draw/texture_list.h"

namespace luxo {
namespace {

static_assert(shared::kLeastShown == kLeastShown);

bool ambientFollowsPattern(const Material& material) {
  return Paint::of(material).valid() && !material.ambient;
}

/// `shadeOf`: LightSets::Choice::shadeOf.
shared::MaterialData materialData(const Material& material, const Vec3& ambient, std::uint32_t shadeOf) {
  const bool follows = ambientFollowsPattern(material);
  return {.ambient = Vec3f(follows ? ambient : material.ambientOrDiffuse() * ambient),
          .shininess = static_cast<float>(material.shininess),
          .diffuse = Vec3f(material.diffuse),
          .opacity = material.transparent() ? static_cast<float>(material.opacity) : 0.0f,
          .specular = Vec3f(material.specular),
          .flags = (material.lectureSpecular ? shared::kLectureSpecular : 0) |
                   (follows ? shared::kPatternAmbient : 0) | shadeOf << shared::kShadeShift,
          .blend = static_cast<std::uint32_t>(material.blend),
          .leastOpaque = static_cast<float>(material.leastOpaque())};
}

static_assert(static_cast<std::uint32_t>(Blend::Over) == shared::kBlendOver &&
              static_cast<std::uint32_t>(Blend::Add) == shared::kBlendAdd &&
              static_cast<std::uint32_t>(Blend::Multiply) == shared::kBlendMultiply);

/// Whether the light on a point is more than its normal, its place and its material.
bool isDrawnAgain(Shading shading) { return shading == Shading::Gouraud || shading == Shading::Toon; }

/// As few groups as have room for all lights; but one some of which gets through its casters is alone. Those
/// that are shaded in closed form are in one, as materials have one shade's number; the last.
std::vector<std::vector<std::uint32_t>> groupsOf(const Snapshot& snapshot,
                                                 std::span<const std::uint32_t> lights, bool closedForms) {
  std::vector<std::vector<std::uint32_t>> groups(1);
  std::vector<std::uint32_t> shaded, alone;
  for (const std::uint32_t light : lights) {
    if (closedForms && snapshot.lights[light].shade) {
      shaded.push_back(light);
      continue;
    }
    if (transmits(snapshot, snapshot.lights[light])) {
      alone.push_back(light);
      continue;
    }
    if (groups.back().size() == shared::kMaxLights) groups.emplace_back();
    groups.back().push_back(light);
  }
  if (groups.back().size() + shaded.size() > shared::kMaxLights) groups.emplace_back();
  groups.back().insert(groups.back().end(), shaded.begin(), shaded.end());
  if (groups.back().empty() && !alone.empty()) groups.pop_back();
  for (const std::uint32_t light : alone) groups.push_back({light});
  return groups;
}

/// Why a group of lights is one of several.
std::string reasonFor(const Snapshot& snapshot, std::span<const std::vector<std::uint32_t>> groups) {
  for (const std::vector<std::uint32_t>& group : groups)
    for (const std::uint32_t number : group) {
      const SnapshotLight& light = snapshot.lights[number];
      if (!transmits(snapshot, light)) continue;
      if (light.map) return fmt::format("that of node number {} has a depth map", light.id.index + 1);
      const auto caster = std::ranges::find_if(light.casters, [&](NodeId id) {
        const auto node = std::ranges::find(snapshot.nodes, id, &SnapshotNode::id);
        return node != snapshot.nodes.end() && snapshot.materials[node->material.index].letsLightThrough();
      });
      return fmt::format("that of node number {} shines through node number {}", light.id.index + 1,
                         caster->index + 1);
    }
  return fmt::format("there are more than {} of them", shared::kMaxLights);
}

/// A shader makes one colour of all lights at once: what it makes of some does not add up to that.
void requireNoShader(const Snapshot& snapshot, std::span<const std::vector<std::uint32_t>> groups) {
  const auto node = std::ranges::find_if(snapshot.nodes, [&](const SnapshotNode& one) {
    return snapshot.materials[one.material.index].shader != nullptr;
  });
  if (node == snapshot.nodes.end()) return;
  throw Error(
      ErrorKind::Scene,
      fmt::format(
          "the shader of node number {} makes one colour of all lights together, but these come in {} "
          "passes: {}",
          node->number, groups.size(), reasonFor(snapshot, groups)),
      "use fewer lights, set their shadows to \"none\", name their \"casters\" without what is seen "
      "through, or take the shader's material without its shader");
}

void requireScreen(const AmbientOcclusion& occlusion, bool possible) {
  if (occlusion.method == OcclusionMethod::Rays)
    throw Error(ErrorKind::Scene, "ambient occlusion by rays is what the reference casts",
                "render with --engine reference, or set render.ambient_occlusion's method to \"screen\"");
  if (!possible)
    throw Error(ErrorKind::Scene,
                fmt::format("ambient occlusion among more than {} nodes and materials is not supported yet",
                            shared::kMaxFoundMaterials - 1),
                "leave render.ambient_occlusion, or some nodes, out");
}

}  // namespace

MaterialList::MaterialList(const Snapshot& snapshot, const VisibleList& visible, const DrawOptions& options,
                           DrawList& list)
    : snapshot_(snapshot), options_(options), list_(list) {
  const std::set<std::uint32_t> distinct(visible.lights.begin(), visible.lights.end());
  const std::vector<std::uint32_t> lights(distinct.begin(), distinct.end());
  const std::vector<Material>& materials = snapshot.materials;
  const bool closedForms = hasClosedForms(snapshot, options);
  shadows_ = findsShadows(snapshot, options) && std::ranges::any_of(lights, [&](std::uint32_t light) {
               return asksCasters(snapshot.lights[light], closedForms);
             });
  const bool textures = std::ranges::any_of(materials, &Material::drawsMaps);
  const bool possible = options.output == Output::Color && !showsData(options.shading) &&
                        options.samples == 1 &&
                        (shadows_ || hasLayers(snapshot, options) || textures
                             ? snapshot.nodes.size()
                             : materials.size() * (lights.size() + 1)) < shared::kMaxFoundMaterials;
  const bool occludes = occludesAmbient(snapshot, options), traces = tracesRays(snapshot, options);
  if (occludes) requireScreen(snapshot.ambientOcclusion, possible);
  if (traces && !possible)
    throw Error(ErrorKind::Scene,
                fmt::format("rays of shaders among more than {} nodes and materials are not supported yet",
                            shared::kMaxFoundMaterials - 1),
                "leave out some nodes, or take the shader's material without trace()");
  crowded_ = std::ranges::any_of(visible.opaque, [&](const VisibleNode& node) {
    const Material& material = materials[snapshot.nodes[node.node].material.index];
    return node.lightCount > shared::kMaxLights && material.shadingIn(options.shading) != Shading::Wireframe;
  });
  const bool wanted = options.composition == Composition::Deferred && lights.size() <= shared::kMaxLights;
  list_.deferred =
      possible && (wanted || shadows_ || crowded_ || hasLayers(snapshot, options) || occludes || traces);
  list_.occludes = occludes;
  list_.traces = traces;
  // Of geometry where it may have holes.
  list_.runsShaders =
      (options.output == Output::Color || (showsGeometry(options.output) && hasLayers(snapshot, options))) &&
      std::ranges::any_of(materials, [](const Material& material) { return material.shader != nullptr; });
  if (list_.deferred || hasLayers(snapshot, options)) {
    if (options.output == Output::Color)
      groups_ = groupsOf(snapshot, lights, closedForms);
    else
      groups_.resize(1);  // no light: of geometry no more is asked than how opaque it is
  }
  if (groups_.size() > 1) requireNoShader(snapshot, groups_);
  list_.groups.resize(groups_.size());
  shades_.resize(groups_.size());
  layerShades_.resize(groups_.size());
  list_.findsParameters = list_.deferred && std::ranges::any_of(materials, [](const Material& material) {
                            return Paint::of(material).valid();
                          });
  list_.findsPlaces =
      list_.deferred && shadows_ && std::ranges::any_of(visible.opaque, [&](const VisibleNode& node) {
        return isOnlyNear(snapshot, snapshot.nodes[node.node], options);
      });
  const auto some = [&](const auto& ofMaterial) { return std::ranges::any_of(materials, ofMaterial); };
  list_.findsFootprints = list_.deferred && some([](const Material& material) {
                            return material.readsFootprint() && !material.transparent();
                          });
  list_.findsFrames = list_.deferred && some([](const Material& material) {
                        return Paint::of(material).readsFrame() && !material.transparent();
                      });
  list_.layers.details = hasLayers(snapshot, options) && some([](const Material& material) {
                           return material.readsFootprint() && material.transparent();
                         });
}

std::uint32_t MaterialList::numberOf(std::uint32_t index, std::uint32_t shadeOf, std::uint32_t node) {
  const Material& material = snapshot_.materials[index];
  const bool ofNode = shadows_ || material.transparent() || material.drawsMaps();
  const auto [entry, isNew] = numberOf_.try_emplace({index, shadeOf, ofNode ? node : 0},
                                                    static_cast<std::uint32_t>(list_.materials.size()));
  if (shadows_) numberOfNode_[node] = entry->second;
  if (!isNew) return entry->second;
  shared::MaterialData data = materialData(material, snapshot_.ambient, shadeOf);
  if (const Paint paint = Paint::of(material); paint.valid()) {
    data.pattern = patternNumber(paint);
    data.firstPatternParameter = firstPatternParameter(material, snapshot_.nodes[node], paint);
    if (paint.readsFootprint()) requireTexels(list_.textures);
  }
  if (options_.output == Output::Color && isDrawnAgain(material.shadingIn(options_.shading)))
    data.pattern = shared::kDrawnAgain;
  if (ofNode) data.blend |= snapshot_.nodes[node].number << shared::kIdShift;
  list_.materials.push_back(data);
  return entry->second;
}

std::uint32_t MaterialList::numberOfNode(std::uint32_t node) const {
  const auto known = numberOfNode_.find(node);
  return known == numberOfNode_.end() ? shared::kMaxFoundMaterials : known->second;
}

std::uint32_t MaterialList::firstPatternParameter(const Material& material, const SnapshotNode& node,
                                                  const Paint& paint) {
  std::vector<float>& all = list_.patternParameters;
  const auto first = static_cast<std::uint32_t>(all.size());
  if (paint.isTexture())
    appendMaps(material, node, list_.textures, all);
  else
    all.insert(all.end(), material.patternParameters.begin(), material.patternParameters.end());
  if (paint.shader()) appendShader(material, node, list_.origin, snapshot_.ambient, all);
  if (paint.isolines().valid())
    all.insert(all.end(), material.isolineParameters.begin(), material.isolineParameters.end());
  if (all.empty()) all.push_back(0);  // something to bind
  return first;
}

std::uint32_t MaterialList::patternNumber(const Paint& pattern) {
  if (!pattern.valid()) return 0;
  return patternNumbers_.try_emplace(pattern, static_cast<std::uint32_t>(patternNumbers_.size() + 1))
      .first->second;
}

bool MaterialList::litLater(const DrawState& state) const {
  return list_.deferred && !state.blended &&
         (state.shading == Shading::Exact || state.shading == Shading::Phong ||
          state.shading == Shading::Flat || ((shadows_ || crowded_) && isDrawnAgain(state.shading)));
}

LightSets::Choice MaterialList::lightLater(DrawBatch& batch, LightSets& lightSets, const SnapshotNode& node) {
  DrawState& state = batch.state;
  if (isDrawnAgain(state.shading))
    batch.again = DrawState{.shading = state.shading, .form = Form::Again, .pattern = state.pattern};
  const std::uint32_t shadeOf = shadeLater(
      {.shading = state.shading, .form = Form::Shade, .pattern = state.pattern}, lightSets, node, shades_);
  const bool isMesh = list_.findsPlaces && !findsSurface(snapshot_, node, options_);
  state.form = list_.findsParameters || isMesh ? Form::FoundWithParameters : Form::Found;
  state.footprint = list_.findsFootprints;
  state.frame = list_.findsFrames;
  state.pattern = {};
  if (batch.again) state.shading = Shading::Phong;
  return {.shadeOf = shadeOf};
}

LightSets::Choice MaterialList::lightLayer(DrawBatch& batch, LightSets& lightSets, const SnapshotNode& node) {
  DrawState& state = batch.state;
  if (isDrawnAgain(state.shading))
    batch.again = DrawState{.shading = state.shading, .form = Form::LayerAgain, .pattern = state.pattern};
  const std::uint32_t shadeOf =
      shadeLater({.shading = state.shading, .form = Form::ShadeLayers, .pattern = state.pattern}, lightSets,
                 node, layerShades_);
  state.form = Form::Layer;
  state.pattern = {};
  if (batch.again) state.shading = Shading::Phong;
  return {.shadeOf = shadeOf};
}

std::uint32_t MaterialList::shadeLater(const DrawState& shade, LightSets& lightSets, const SnapshotNode& node,
                                       std::vector<std::set<DrawState>>& shades) {
  std::uint32_t shadeOf = 0;
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    LightSets::Choice choice = lightSets.choose(groups_[i], node);
    if (!isDrawnAgain(shade.shading) && options_.output != Output::Certificate)
      shades[i].insert({.output = options_.output,
                        .form = shade.form,
                        .plainLights = choice.plain,
                        .shadedLights = choice.shaded,
                        .spots = choice.spots,
                        .pattern = shade.pattern,
                        .patternNumber = patternNumber(shade.pattern),
                        .manyGroups = groups_.size() > kKeptGroups,
                        .addsLight = i > 0,
                        .occludes = list_.occludes && i == 0});
    list_.groups[i].lightSet = choice.index;
    list_.groups[i].plainLights = choice.plain;
    list_.groups[i].shadedLights = choice.shaded;
    list_.groups[i].spots = choice.spots;
    groups_[i] = std::move(choice.lights);
    shadeOf = std::max(shadeOf, choice.shadeOf);
  }
  return shadeOf;
}

/// For each group of lights a draw; of light between vertices as many as it takes.
void MaterialList::listAgain(const DrawBatch& batch, bool layer) {
  const bool inPieces = batch.again->shading == Shading::Gouraud;
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    LightGroup& group = list_.groups[i];
    const std::uint32_t lights = group.plainLights + group.shadedLights;
    for (std::uint32_t first = 0; first == 0 || (inPieces && first < lights);
         first += shared::kVertexLights) {
      DrawBatch& again = (layer ? group.layerAgain : group.again).emplace_back(batch);
      again.state = *batch.again;
      again.state.plainLights = group.plainLights;
      again.state.shadedLights = group.shadedLights;
      again.state.spots = group.spots;
      again.state.manyGroups = groups_.size() > kKeptGroups;
      again.state.addsLight = i > 0 || first > 0;
      again.state.firstLight = first;
      again.lightSet = group.lightSet;
    }
  }
}

void MaterialList::listShades() {
  const auto listed = [this](const std::set<DrawState>& states) {
    std::vector<DrawState> shades(states.begin(), states.end());
    for (DrawState& shade : shades) shade.manyMaterials = list_.materials.size() > shared::kUniformMaterials;
    std::ranges::sort(shades, {}, &DrawState::patternNumber);
    return shades;
  };
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    list_.groups[i].shades = listed(shades_[i]);
    list_.groups[i].layerShades = listed(layerShades_[i]);
  }
  for (const DrawBatch& batch : list_.opaque)
    if (batch.again) listAgain(batch, false);
  // Neighbours whose light joins that of others alike are drawn in one pass. Every pixel is of one node, so
  // that the order of nodes is no matter.
  for (LightGroup& group : list_.groups)
    std::ranges::stable_sort(group.again, {}, [](const DrawBatch& again) {
      return std::tuple(again.state.addsLight, again.state.shading, again.state.firstLight);
    });
  for (const DrawBatch& batch : list_.layers.meshes)
    if (batch.again) listAgain(batch, true);
}

}  // namespace luxo
