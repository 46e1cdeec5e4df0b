// SPDX-License-Identifier: Apache-2.0
#include "draw/scene_layouts.h"

#include "shared/scene_data.h"

namespace luxo {
namespace {

using gpu::DescriptorBinding;

constexpr DescriptorBinding kBuffer{.type = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
    kUniforms{.type = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER},
    kSomeUniforms{.type = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC},
    kImage{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_SHADER_STAGE_FRAGMENT_BIT},
    kTexels{VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, VK_SHADER_STAGE_FRAGMENT_BIT};

std::vector<DescriptorBinding> bindingsOf(SceneSet set) {
  using namespace shared;
  std::vector<DescriptorBinding> bindings;
  switch (set) {
    case SceneSet::Scene:
      bindings.assign(kSceneBindings, kBuffer);
      bindings[kBindingView] = kUniforms;
      bindings[kBindingLights] = kSomeUniforms;
      bindings[kBindingShaderFaults] = {kBuffer.type, VK_SHADER_STAGE_FRAGMENT_BIT};
      break;
    case SceneSet::Pattern:
      bindings = {kBuffer};
      break;
    case SceneSet::Texture:
      bindings = {kBuffer, kTexels};
      break;
    case SceneSet::FoundTexture:
      bindings = {kBuffer, kTexels, kImage, kImage};
      break;
    case SceneSet::Exact:
      bindings.assign(kExactBindings, kBuffer);
      break;
    case SceneSet::Found:
      bindings.assign(kFoundBindings, kImage);
      bindings[kBindingUniformMaterials] = {kUniforms.type, VK_SHADER_STAGE_FRAGMENT_BIT};
      for (const std::uint32_t i : {kBindingTraceQuestions, kBindingTraceStarts, kBindingTraceAnswers})
        bindings[i] = {kBuffer.type, VK_SHADER_STAGE_FRAGMENT_BIT};
      break;
    case SceneSet::Shadow:
      bindings.assign(kShadowBindings, kBuffer);
      bindings[kBindingLightDepths] = kImage;
      bindings[kBindingCasterTexels] = kTexels;
      break;
    case SceneSet::Layers:
      bindings.assign(kLayerBindings, kBuffer);
      bindings[kBindingLayerDepth] = bindings[kBindingLayersFound] = kImage;
      bindings[kBindingLayerMaterials] = {kUniforms.type, VK_SHADER_STAGE_FRAGMENT_BIT};
      break;
  }
  return bindings;
}

std::vector<SceneSet> setsOf(const DrawState& state) {
  using enum Form;
  using Set = SceneSet;
  const Set paint = !state.pattern.readsFootprint() ? Set::Pattern
                    : state.form == Shade           ? Set::FoundTexture
                                                    : Set::Texture;
  switch (state.form) {
    case LightDepth:
      return {Set::Scene};
    case Fused:
    case Found:
    case FoundWithParameters:
      if (state.surface) return {Set::Scene, paint, Set::Exact};
      return {Set::Scene, paint};
    case Shade:
    case Again:
    case Openness:
    case AddLight:
      return {Set::Scene, paint, Set::Found};
    case FlatShadow:
    case FlatTransmittance:
      return {Set::Scene, state.pattern.valid() ? paint : Set::Shadow, Set::Found};
    case MeshPlace:
    case Shadow:
    case Transmittance:
    case ShadowsByRays:
    case TransmittanceByRays:
    case LightMap:
      return {Set::Scene, Set::Shadow, Set::Found};
    case LayerPlace:
    case LayerShadow:
    case LayerTransmittance:
    case LayerLightMap:
      return {Set::Scene, Set::Shadow, Set::Found, Set::Layers};
    case Layer:
      return {Set::Scene, state.surface ? Set::Shadow : paint, Set::Found, Set::Layers};
    case LayersByRays:
    case ShadeLayers:
    case BlendLayers:
    case LayerAgain:
      return {Set::Scene, paint, Set::Found, Set::Layers};
  }
  return {};
}
static_assert(shared::kSetScene == 0 && shared::kSetPattern == 1 && shared::kSetShadow == 1 &&
              shared::kSetExact == 2 && shared::kSetFound == 2 && shared::kSetLayers == 3);

}  // namespace

const gpu::DescriptorLayout& SceneLayouts::get(SceneSet set) {
  gpu::DescriptorLayout& layout = layouts_[static_cast<std::size_t>(set)];
  if (layout.bindings().empty()) layout = gpu::DescriptorLayout(*context_, bindingsOf(set));
  return layout;
}

gpu::SetLayouts SceneLayouts::of(const DrawState& state) {
  gpu::SetLayouts layouts;
  for (const SceneSet set : setsOf(state)) layouts.push_back(get(set));
  return layouts;
}

}  // namespace luxo
