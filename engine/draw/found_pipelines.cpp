// SPDX-License-Identifier: Apache-2.0
// Pipelines that work on points which earlier passes have found: what light reaches them, and what they
// reflect of it.
#include <cstddef>
#include <span>

#include "base/error.h"
#include "draw/ray_points.h"
#include "draw/scene_pipelines.h"
#include "luxo/shaders/blend_layers_frag.h"
#include "luxo/shaders/closed_layer_shadow_frag.h"
#include "luxo/shaders/closed_shadow_frag.h"
#include "luxo/shaders/closed_shadow_vert.h"
#include "luxo/shaders/flat_shadow_frag.h"
#include "luxo/shaders/flat_shadow_vert.h"
#include "luxo/shaders/flat_transmittance_frag.h"
#include "luxo/shaders/light_depth_vert.h"
#include "luxo/shaders/light_map_frag.h"
#include "luxo/shaders/light_map_layer_frag.h"
#include "luxo/shaders/light_map_vert.h"
#include "luxo/shaders/mesh_place_vert.h"
#include "luxo/shaders/openness_frag.h"
#include "luxo/shaders/openness_vert.h"
#include "luxo/shaders/ray_layers_frag.h"
#include "luxo/shaders/ray_layers_vert.h"
#include "luxo/shaders/ray_shadows_frag.h"
#include "luxo/shaders/ray_shadows_vert.h"
#include "luxo/shaders/ray_transmittance_frag.h"
#include "luxo/shaders/ray_transmittance_vert.h"
#include "luxo/shaders/shade_frag.h"
#include "luxo/shaders/shade_in_shadows_frag.h"
#include "luxo/shaders/shade_layers_frag.h"
#include "luxo/shaders/shade_vert.h"
#include "luxo/shaders/shadow_vert.h"
#include "luxo/shaders/whole_target_vert.h"

namespace luxo {

/// One triangle over all, as far as can be: what is nearer than that has been found.
void ScenePipelines::describeShade(const DrawState& state, gpu::GraphicsPipelineDesc& desc) {
  desc.name = "shade";
  desc.vertexShader = luxo_shade_vert;
  if (state.pattern.valid())
    desc.fragmentShader =
        patternShader(state, state.shadows ? "pattern/shade_in_shadows.frag" : "pattern/shade.frag");
  else
    desc.fragmentShader = state.shadows ? std::span<const std::uint32_t>(luxo_shade_in_shadows_frag)
                                        : std::span<const std::uint32_t>(luxo_shade_frag);
  desc.bindings.clear();
  desc.attributes.clear();
  desc.depthWrite = false;
  desc.depthCompare = VK_COMPARE_OP_LESS;
  desc.specialization.insert(desc.specialization.end(),
                             {{shared::kConstantPattern, state.patternNumber},
                              {shared::kConstantManyMaterials, state.manyMaterials},
                              {shared::kConstantAddsLight, state.addsLight},
                              {shared::kConstantTransmits, state.transmits},
                              {shared::kConstantOcclusion, state.occludes}});
  if (state.addsLight) desc.blend = gpu::Blend::Add;
  desc.setLayouts = {sceneLayout_, paintLayout(state), foundLayout()};
}

/// The same, of the ambient light.
void ScenePipelines::describeOpenness(gpu::GraphicsPipelineDesc& desc) {
  desc.name = "openness";
  desc.vertexShader = luxo_openness_vert;
  desc.fragmentShader = luxo_openness_frag;
  desc.colorFormats = {kOpennessFormat};
  desc.bindings.clear();
  desc.attributes.clear();
  desc.depthWrite = false;
  desc.depthCompare = VK_COMPARE_OP_LESS;
  desc.setLayouts = {sceneLayout_, patternLayout(), foundLayout()};
}

/// Over all that was found, of a mesh the points of its surface.
void ScenePipelines::describePlaces(const DrawState& state, gpu::GraphicsPipelineDesc& desc) {
  desc.name = "places";
  desc.vertexShader = luxo_mesh_place_vert;
  desc.fragmentShader = casterShader(state);
  desc.colorFormats = {kPlacesFormat};
  desc.depthWrite = false;
  desc.depthCompare = VK_COMPARE_OP_LESS;
  desc.bindings.clear();
  desc.attributes.clear();
  desc.specialization = {{shared::kConstantParameterCount, state.surface->parameters}};
  desc.setLayouts = {sceneLayout_, shadowLayout(), foundLayout()};
}

/// Over all that was found, of a light that does not reach it a bit, or how much of it does; or what rays
/// know of all lights there.
void ScenePipelines::describeShadow(const DrawState& state, gpu::GraphicsPipelineDesc& desc) {
  const bool bits =
      state.form == Form::Shadow || state.form == Form::ShadowsByRays || state.form == Form::FlatShadow;
  if (bits && !context_->features().logicOp)
    throw Error(ErrorKind::Device, "this device cannot draw shadows (no logicOp)",
                "choose another --device, or set the lights' shadows to \"none\"");
  desc.name = "shadow";
  desc.colorFormats = {bits ? kShadowsFormat : kTransmittanceFormat};
  desc.depthWrite = false;
  desc.depthCompare = VK_COMPARE_OP_ALWAYS;
  desc.blend = bits ? gpu::Blend::Or : gpu::Blend::Multiply;
  desc.bindings.clear();
  desc.attributes.clear();
  desc.specialization.clear();
  desc.setLayouts = {sceneLayout_, shadowLayout(), foundLayout()};
  if (state.form == Form::ShadowsByRays || state.form == Form::TransmittanceByRays) {
    desc.vertexShader = bits ? std::span<const std::uint32_t>(luxo_ray_shadows_vert)
                             : std::span<const std::uint32_t>(luxo_ray_transmittance_vert);
    desc.fragmentShader = bits ? std::span<const std::uint32_t>(luxo_ray_shadows_frag)
                               : std::span<const std::uint32_t>(luxo_ray_transmittance_frag);
    desc.bindings = {{0, sizeof(RayShadow), VK_VERTEX_INPUT_RATE_VERTEX}};
    constexpr std::size_t kLight = offsetof(RayShadow, light);
    desc.attributes = {{0, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(RayShadow, place)}};
    if (bits)
      desc.attributes.push_back(
          {1, 0, VK_FORMAT_R32_UINT, kLight + offsetof(shared::ReachingLight, shadows)});
    else
      desc.attributes.push_back(
          {1, 0, VK_FORMAT_R32G32B32_SFLOAT, kLight + offsetof(shared::ReachingLight, transmittance)});
    desc.blend = gpu::Blend::None;
    desc.pushConstantBytes = sizeof(RayTarget);
    desc.setLayouts = {sceneLayout_};
  } else if (state.form == Form::FlatShadow || state.form == Form::FlatTransmittance) {
    desc.vertexShader = luxo_flat_shadow_vert;
    desc.fragmentShader = bits ? std::span<const std::uint32_t>(luxo_flat_shadow_frag)
                               : std::span<const std::uint32_t>(luxo_flat_transmittance_frag);
    desc.bindings = {{0, 2 * sizeof(Vec3f), VK_VERTEX_INPUT_RATE_VERTEX}};
    desc.attributes = {{0, 0, VK_FORMAT_R32G32B32_SFLOAT, 0}};
    desc.pushConstantBytes = sizeof(shared::FlatShadow);
  } else if (state.form == Form::LightMap) {
    desc.vertexShader = luxo_light_map_vert;
    desc.fragmentShader = luxo_light_map_frag;
    desc.depthCompare = VK_COMPARE_OP_LESS;
  } else {
    desc.depthCompare = VK_COMPARE_OP_LESS;
    describeCaster(state, desc);
  }
}

/// By its cells, or some by their equations.
void ScenePipelines::describeCaster(const DrawState& state, gpu::GraphicsPipelineDesc& desc) const {
  if (state.closed == 0) {
    desc.vertexShader = luxo_shadow_vert;
    desc.fragmentShader = casterShader(state);
    desc.specialization = {{shared::kConstantParameterCount, state.surface->parameters},
                           {shared::kConstantPlaces, state.places}};
    if (state.form == Form::Layer)
      desc.specialization.push_back({shared::kConstantLayerDetails, state.details});
    return;
  }
  desc.vertexShader = luxo_closed_shadow_vert;
  desc.fragmentShader = state.form == Form::Shadow
                            ? std::span<const std::uint32_t>(luxo_closed_shadow_frag)
                            : std::span<const std::uint32_t>(luxo_closed_layer_shadow_frag);
  desc.specialization = {{shared::kConstantClosedCasters, state.closed},
                         {shared::kConstantClosedKind, state.closedKind},
                         {shared::kConstantPlaces, state.places}};
}

/// A mesh as a light sees it.
void ScenePipelines::describeLightDepth(gpu::GraphicsPipelineDesc& desc) {
  desc.name = "light depth";
  desc.vertexShader = luxo_light_depth_vert;
  desc.bindings = {{0, 2 * sizeof(Vec3f), VK_VERTEX_INPUT_RATE_VERTEX}};
  desc.attributes = {{0, 0, VK_FORMAT_R32G32B32_SFLOAT, 0}};
  desc.samples = VK_SAMPLE_COUNT_1_BIT;
  desc.colorFormats.clear();
  desc.depthClamp = true;
  desc.specialization.clear();
  desc.pushConstantBytes = sizeof(Mat4f);
}

/// All points of a surface that is seen through, in every pixel; or what is done with the points of all.
void ScenePipelines::describeLayers(const DrawState& state, gpu::GraphicsPipelineDesc& desc) {
  desc.name = "layers";
  desc.vertexShader = luxo_whole_target_vert;
  desc.depthTest = desc.depthWrite = false;
  if (state.form == Form::BlendLayers) {
    if (!context_->features().dualSrcBlend)
      throw Error(ErrorKind::Device, "this device cannot draw what is seen through (no dualSrcBlend)",
                  "choose another --device");
    desc.fragmentShader = luxo_blend_layers_frag;
    desc.blend = gpu::Blend::Through;
    desc.specialization = {{shared::kConstantGivenOrder, state.givenOrder}};
  } else if (state.form == Form::ShadeLayers) {
    desc.vertexShader = luxo_shade_vert;
    desc.fragmentShader =
        state.pattern.valid()
            ? std::span<const std::uint32_t>(patternShader(state, "pattern/shade_layers.frag"))
            : std::span<const std::uint32_t>(luxo_shade_layers_frag);
    desc.specialization.insert(desc.specialization.end(),
                               {{shared::kConstantPattern, state.patternNumber},
                                {shared::kConstantManyMaterials, state.manyMaterials},
                                {shared::kConstantAddsLight, state.addsLight},
                                {shared::kConstantManyGroups, state.manyGroups},
                                {shared::kConstantTransmits, state.transmits}});
  } else if (state.form == Form::LayersByRays) {
    desc.vertexShader = luxo_ray_layers_vert;
    desc.fragmentShader = luxo_ray_layers_frag;
    desc.bindings = {{0, sizeof(RayLayers), VK_VERTEX_INPUT_RATE_VERTEX}};
    desc.attributes = {{0, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(RayLayers, place)},
                       {1, 0, VK_FORMAT_R32G32B32_UINT, offsetof(RayLayers, first)}};
    desc.specialization = {{shared::kConstantLayerDetails, state.details}};
    desc.pushConstantBytes = sizeof(RayTarget);
    return;
  } else if (state.form == Form::LayerPlace) {
    desc.vertexShader = luxo_mesh_place_vert;
    desc.fragmentShader = casterShader(state);
    desc.specialization = {{shared::kConstantParameterCount, state.surface->parameters}};
  } else if (state.form == Form::LayerLightMap) {
    desc.vertexShader = luxo_light_map_vert;
    desc.fragmentShader = luxo_light_map_layer_frag;
    desc.specialization.clear();
  } else {
    describeCaster(state, desc);
  }
  desc.bindings.clear();
  desc.attributes.clear();
}

}  // namespace luxo
