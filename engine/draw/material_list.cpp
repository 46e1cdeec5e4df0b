// SPDX-License-Identifier: Apache-2.0
#include "draw/material_list.h"

#include <algorithm>

#include "draw/shadow_list.h"

namespace luxo {
namespace {

bool ambientFollowsPattern(const Material& material) {
  return material.diffusePattern.valid() && !material.ambient;
}

/// `shadeOf`: 1 + which of the shaded lights it is the shade of.
shared::MaterialData materialData(const Material& material, const Vec3& ambient, std::uint32_t shadeOf) {
  const bool follows = ambientFollowsPattern(material);
  return {.ambient = Vec3f(follows ? ambient : material.ambientOrDiffuse() * ambient),
          .shininess = static_cast<float>(material.shininess),
          .diffuse = Vec3f(material.diffuse),
          .opacity = material.transparent() ? static_cast<float>(material.opacity) : 0.0f,
          .specular = Vec3f(material.specular),
          .flags = (material.lectureSpecular ? shared::kLectureSpecular : 0) |
                   (follows ? shared::kPatternAmbient : 0) | shadeOf << shared::kShadeShift};
}

/// As few groups as have room for all lights. Those that are shaded in closed form are in one, the last, as
/// they are the last of their sets.
std::vector<std::vector<std::uint32_t>> groupsOf(const Snapshot& snapshot,
                                                 std::span<const std::uint32_t> lights) {
  std::vector<std::vector<std::uint32_t>> groups(1);
  std::vector<std::uint32_t> shaded;
  for (const std::uint32_t light : lights) {
    if (snapshot.lights[light].shade) {
      shaded.push_back(light);
      continue;
    }
    if (groups.back().size() == shared::kMaxLights) groups.emplace_back();
    groups.back().push_back(light);
  }
  if (groups.back().size() + shaded.size() > shared::kMaxLights) groups.emplace_back();
  groups.back().insert(groups.back().end(), shaded.begin(), shaded.end());
  return groups;
}

}  // namespace

MaterialList::MaterialList(const Snapshot& snapshot, const VisibleList& visible, const DrawOptions& options,
                           DrawList& list)
    : snapshot_(snapshot), list_(list) {
  const std::set<std::uint32_t> distinct(visible.lights.begin(), visible.lights.end());
  const std::vector<std::uint32_t> lights(distinct.begin(), distinct.end());
  const std::vector<Material>& materials = snapshot.materials;
  shadows_ = findsShadows(snapshot, options) && std::ranges::any_of(lights, [&](std::uint32_t light) {
               return !snapshot.lights[light].casters.empty();
             });
  const bool possible = options.output == Output::Color && options.samples == 1 &&
                        (shadows_ || lights.size() <= shared::kMaxLights) &&
                        (shadows_ ? snapshot.nodes.size() : materials.size() * (lights.size() + 1)) <
                            shared::kMaxFoundMaterials;
  list_.deferred = possible && (options.composition == Composition::Deferred || shadows_);
  if (list_.deferred) groups_ = groupsOf(snapshot, lights);
  list_.groups.resize(groups_.size());
  shades_.resize(groups_.size());
  withPatterns_ = list_.deferred && std::ranges::any_of(materials, [](const Material& material) {
                    return material.diffusePattern.valid();
                  });
}

std::uint32_t MaterialList::numberOf(std::uint32_t index, std::uint32_t shadeOf, std::uint32_t node) {
  const auto [entry, isNew] = numberOf_.try_emplace({index, shadeOf, shadows_ ? node : 0},
                                                    static_cast<std::uint32_t>(list_.materials.size()));
  if (shadows_) numberOfNode_[node] = entry->second;
  if (!isNew) return entry->second;
  const Material& material = snapshot_.materials[index];
  shared::MaterialData data = materialData(material, snapshot_.ambient, shadeOf);
  if (material.diffusePattern.valid()) {
    data.pattern = patternNumber(material.diffusePattern);
    data.firstPatternParameter = firstPatternParameter(material);
  }
  list_.materials.push_back(data);
  return entry->second;
}

std::uint32_t MaterialList::numberOfNode(std::uint32_t node) const {
  const auto known = numberOfNode_.find(node);
  return known == numberOfNode_.end() ? shared::kMaxFoundMaterials : known->second;
}

std::uint32_t MaterialList::firstPatternParameter(const Material& material) {
  std::vector<float>& all = list_.patternParameters;
  const auto first = static_cast<std::uint32_t>(all.size());
  all.insert(all.end(), material.patternParameters.begin(), material.patternParameters.end());
  if (all.empty()) all.push_back(0);  // something to bind
  return first;
}

std::uint32_t MaterialList::patternNumber(const Pattern& pattern) {
  if (!pattern.valid()) return 0;
  return patternNumbers_.try_emplace(pattern, static_cast<std::uint32_t>(patternNumbers_.size() + 1))
      .first->second;
}

bool MaterialList::litLater(const DrawState& state) const {
  return list_.deferred && !state.blended &&
         (state.shading == Shading::Exact || state.shading == Shading::Phong ||
          state.shading == Shading::Flat);
}

LightSets::Choice MaterialList::lightLater(DrawState& state, LightSets& lightSets, const SnapshotNode& node) {
  std::uint32_t shadeOf = 0;
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    LightSets::Choice choice = lightSets.choose(groups_[i], node);
    shades_[i].insert({.form = Form::Shade,
                       .plainLights = choice.plain,
                       .shadedLights = choice.shaded,
                       .pattern = state.pattern,
                       .patternNumber = patternNumber(state.pattern),
                       .addsLight = i > 0});
    list_.groups[i].lightSet = choice.index;
    groups_[i] = std::move(choice.lights);
    shadeOf = std::max(shadeOf, choice.shadeOf);
  }
  state.form = withPatterns_ ? Form::FoundWithParameters : Form::Found;
  state.pattern = {};
  return {.shadeOf = shadeOf};
}

void MaterialList::listShades() {
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    std::vector<DrawState>& shades = list_.groups[i].shades;
    shades.assign(shades_[i].begin(), shades_[i].end());
    for (DrawState& shade : shades) shade.manyMaterials = list_.materials.size() > shared::kUniformMaterials;
    std::ranges::sort(shades, {}, &DrawState::patternNumber);
  }
}

}  // namespace luxo
