// SPDX-License-Identifier: Apache-2.0
#include "draw/scene_programs.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string>

#include "draw/exact_shaders.h"
#include "draw/exact_source.h"
#include "gpu/shader_compiler.h"
#include "luxo/shaders/add_light_frag.h"
#include "luxo/shaders/blend_layers_frag.h"
#include "luxo/shaders/closed_layer_shadow_frag.h"
#include "luxo/shaders/closed_shadow_frag.h"
#include "luxo/shaders/closed_shadow_vert.h"
#include "luxo/shaders/exact_double_vert.h"
#include "luxo/shaders/exact_vert.h"
#include "luxo/shaders/flat_pattern_vert.h"
#include "luxo/shaders/flat_shadow_frag.h"
#include "luxo/shaders/flat_shadow_vert.h"
#include "luxo/shaders/flat_transmittance_frag.h"
#include "luxo/shaders/found_footprint_frag.h"
#include "luxo/shaders/found_frame_frag.h"
#include "luxo/shaders/found_parameters_frag.h"
#include "luxo/shaders/found_tangent_frag.h"
#include "luxo/shaders/gouraud_again_frag.h"
#include "luxo/shaders/gouraud_again_vert.h"
#include "luxo/shaders/gouraud_frag.h"
#include "luxo/shaders/gouraud_layer_frag.h"
#include "luxo/shaders/gouraud_pattern_vert.h"
#include "luxo/shaders/gouraud_vert.h"
#include "luxo/shaders/inspect_frag.h"
#include "luxo/shaders/inspect_layers_frag.h"
#include "luxo/shaders/inspect_vert.h"
#include "luxo/shaders/light_depth_vert.h"
#include "luxo/shaders/light_map_frag.h"
#include "luxo/shaders/light_map_layer_frag.h"
#include "luxo/shaders/light_map_vert.h"
#include "luxo/shaders/mesh_place_vert.h"
#include "luxo/shaders/openness_frag.h"
#include "luxo/shaders/openness_vert.h"
#include "luxo/shaders/ray_found_footprint_frag.h"
#include "luxo/shaders/ray_found_frame_frag.h"
#include "luxo/shaders/ray_inspect_vert.h"
#include "luxo/shaders/ray_layers_frag.h"
#include "luxo/shaders/ray_layers_vert.h"
#include "luxo/shaders/ray_shadows_frag.h"
#include "luxo/shaders/ray_shadows_vert.h"
#include "luxo/shaders/ray_surface_frame_vert.h"
#include "luxo/shaders/ray_surface_pattern_vert.h"
#include "luxo/shaders/ray_surface_texture_vert.h"
#include "luxo/shaders/ray_surface_vert.h"
#include "luxo/shaders/ray_transmittance_frag.h"
#include "luxo/shaders/ray_transmittance_vert.h"
#include "luxo/shaders/shade_frag.h"
#include "luxo/shaders/shade_in_shadows_frag.h"
#include "luxo/shaders/shade_layers_frag.h"
#include "luxo/shaders/shade_vert.h"
#include "luxo/shaders/shadow_vert.h"
#include "luxo/shaders/sources.h"
#include "luxo/shaders/surface_frag.h"
#include "luxo/shaders/surface_layer_frag.h"
#include "luxo/shaders/surface_layer_frame_frag.h"
#include "luxo/shaders/surface_layer_tangent_frag.h"
#include "luxo/shaders/surface_pattern_vert.h"
#include "luxo/shaders/surface_tangent_vert.h"
#include "luxo/shaders/surface_vert.h"
#include "luxo/shaders/toon_again_frag.h"
#include "luxo/shaders/toon_frag.h"
#include "luxo/shaders/toon_layer_frag.h"
#include "luxo/shaders/toon_vert.h"
#include "luxo/shaders/whole_target_vert.h"
#include "luxo/shaders/wireframe_frag.h"
#include "luxo/shaders/wireframe_vert.h"

namespace luxo {
namespace {

using Shader = ScenePrograms::Shader;

/// What the shader of a form finds where rays meet a surface's cells, if that is what it does.
std::optional<ExactSource::Caster> casterOf(Form form) {
  using enum ExactSource::Caster;
  switch (form) {
    case Form::Shadow:
      return Shadow;
    case Form::Transmittance:
      return Transmittance;
    case Form::LayerShadow:
      return LayerShadow;
    case Form::LayerTransmittance:
      return LayerTransmittance;
    case Form::Layer:
      return Layer;
    case Form::MeshPlace:
      return MeshPlace;
    case Form::LayerPlace:
      return LayerPlace;
    default:
      return std::nullopt;
  }
}

/// Of triangles with their parameters.
Shader vertexOfTriangles(const DrawState& state) {
  return state.tangents ? Shader(luxo_surface_tangent_vert) : luxo_surface_pattern_vert;
}

/// Of points that rays have found.
Shader vertexOfRayPoints(const DrawState& state) {
  if (inspectionOf(state)) return luxo_ray_inspect_vert;
  if (state.pattern.readsFrame() || state.frame) return luxo_ray_surface_frame_vert;
  if (state.pattern.readsFootprint() || state.footprint) return luxo_ray_surface_texture_vert;
  return readsParameters(state) ? Shader(luxo_ray_surface_pattern_vert) : luxo_ray_surface_vert;
}

/// Of what is drawn where it is: shells, triangles, points that rays have found.
Shader vertexOfSurfaces(const DrawState& state) {
  if (state.byRays) return vertexOfRayPoints(state);
  if (state.surface)
    return state.surface->number == GlslNumber::Double ? Shader(luxo_exact_double_vert) : luxo_exact_vert;
  if (inspectionOf(state)) return luxo_inspect_vert;
  if (state.shading == Shading::Wireframe) return luxo_wireframe_vert;
  if (state.form == Form::FoundWithParameters) return vertexOfTriangles(state);
  const bool pattern = state.pattern.valid();
  if (state.shading == Shading::Gouraud)
    return pattern ? Shader(luxo_gouraud_pattern_vert) : luxo_gouraud_vert;
  if (pattern) return vertexOfTriangles(state);
  return state.shading == Shading::Toon ? Shader(luxo_toon_vert) : luxo_surface_vert;
}

/// Of triangles, or points of rays, that are lit later, with their parameters.
Shader foundShaderOf(const DrawState& state) {
  if (!state.footprint) return luxo_found_parameters_frag;
  if (state.byRays) return state.frame ? Shader(luxo_ray_found_frame_frag) : luxo_ray_found_footprint_frag;
  return !state.frame     ? Shader(luxo_found_footprint_frag)
         : state.tangents ? Shader(luxo_found_tangent_frag)
                          : luxo_found_frame_frag;
}

/// Of triangles that are seen through.
Shader layerShaderOf(const DrawState& state) {
  return !state.details   ? Shader(luxo_surface_layer_frag)
         : state.tangents ? Shader(luxo_surface_layer_tangent_frag)
                          : luxo_surface_layer_frame_frag;
}

}  // namespace

/// Fused, or found without parameters: one shader does both.
ScenePrograms::ExactShaderKey ScenePrograms::exactShaderKey(const DrawState& state) {
  return {state.surface,   state.pattern, state.grazing, state.form == Form::Found ? Form::Fused : state.form,
          state.footprint, state.frame};
}

void ScenePrograms::prepare(std::span<const DrawState> states) {
  struct Missing {
    ExactShaderKey key;
    gpu::ShaderCompiler::Result shader;
  };
  std::vector<Missing> missing;
  for (const DrawState& state : states) {
    const ExactShaderKey key = exactShaderKey(state);
    if (state.surface && !exactShaders_.contains(key) &&
        std::ranges::none_of(missing, [&](const Missing& m) { return m.key == key; }))
      missing.push_back({key, {}});
  }
  for (const Missing& m : missing)
    if (const MaterialShaderPtr& shader = std::get<Paint>(m.key).shader())
      static_cast<void>(materials_.of(shader));
  tbb::parallel_for(std::size_t{0}, missing.size(), [&](std::size_t i) {
    const auto& [surface, pattern, grazing, form, footprint, frame] = missing[i].key;
    const std::string patternText = pattern.valid() ? pattern.glsl() : "";
    const std::optional<ExactSource::Caster> caster = casterOf(form);
    const bool parameters = form == Form::FoundWithParameters;
    const auto builtIn = footprint ? std::u32string_view()
                         : caster  ? builtInCasterShader(*caster, *surface, patternText)
                                   : builtInExactShader(*surface, patternText, grazing, parameters);
    if (!builtIn.empty()) {
      missing[i].shader.spirv.assign(builtIn.begin(), builtIn.end());
      return;
    }
    ExactSource source = caster ? ExactSource::of(*caster, *surface, patternText)
                                : ExactSource(*surface, patternText, grazing, parameters);
    source.add(pattern.preamble());
    if (footprint) source.add("#define LUXO_TEXTURED\n#define LUXO_FINDS_FOOTPRINT\n");
    if (frame) source.add("#define LUXO_FINDS_FRAME\n");
    MaterialProgram::Joined material;
    if (pattern.shader()) {
      material = materials_.of(pattern.shader()).joined(pattern);
      source.add(material.sources());
    }
    missing[i].shader = gpu::ShaderCompiler().compile(source.desc());
  });
  for (Missing& m : missing) {
    context_->counted().shadersCompiled += m.shader.compiled;
    exactShaders_.emplace(std::move(m.key), std::move(m.shader.spirv));
  }
}

void ScenePrograms::forgetAllBut(std::span<const DrawState* const> used) {
  std::erase_if(exactShaders_, [&](const auto& shader) {
    return std::ranges::none_of(used, [&](const DrawState* state) {
      return state->surface && exactShaderKey(*state) == shader.first;
    });
  });
  std::erase_if(patternShaders_, [&](const auto& shader) {
    return std::ranges::none_of(
        used, [&](const DrawState* state) { return state->pattern == std::get<Paint>(shader.first); });
  });
}

ScenePrograms::Program ScenePrograms::of(const DrawState& state) {
  return {vertexOf(state), fragmentOf(state)};
}

Shader ScenePrograms::vertexOf(const DrawState& state) const {
  using enum Form;
  switch (state.form) {
    case Fused:
    case Found:
    case FoundWithParameters:
      return vertexOfSurfaces(state);
    case Again:
    case LayerAgain:
      return state.shading == Shading::Gouraud ? Shader(luxo_gouraud_again_vert) : vertexOfTriangles(state);
    case Layer:
      return state.surface ? Shader(luxo_shadow_vert) : vertexOfTriangles(state);
    case Shadow:
    case Transmittance:
    case LayerShadow:
    case LayerTransmittance:
      return state.closed > 0 ? Shader(luxo_closed_shadow_vert) : luxo_shadow_vert;
    case MeshPlace:
    case LayerPlace:
      return luxo_mesh_place_vert;
    case ShadowsByRays:
      return luxo_ray_shadows_vert;
    case TransmittanceByRays:
      return luxo_ray_transmittance_vert;
    case LayersByRays:
      return luxo_ray_layers_vert;
    case FlatShadow:
    case FlatTransmittance:
      return state.pattern.valid() ? Shader(luxo_flat_pattern_vert) : luxo_flat_shadow_vert;
    case LightDepth:
      return luxo_light_depth_vert;
    case LightMap:
    case LayerLightMap:
      return luxo_light_map_vert;
    case Shade:
    case ShadeLayers:
      return luxo_shade_vert;
    case Openness:
      return luxo_openness_vert;
    case AddLight:
    case BlendLayers:
      return luxo_whole_target_vert;
  }
  return {};
}

Shader ScenePrograms::fragmentOf(const DrawState& state) {
  using enum Form;
  const bool gouraud = state.shading == Shading::Gouraud;
  switch (state.form) {
    case Fused:
    case Found:
    case FoundWithParameters:
      return state.surface ? exactShader(state) : fragmentOfTriangles(state);
    case Again:
      return gouraud ? withPattern(state, "pattern/gouraud_again.frag", luxo_gouraud_again_frag)
                     : withPattern(state, "pattern/toon_again.frag", luxo_toon_again_frag);
    case LayerAgain:
      return gouraud ? withPattern(state, "pattern/gouraud_layer.frag", luxo_gouraud_layer_frag)
                     : withPattern(state, "pattern/toon_layer.frag", luxo_toon_layer_frag);
    case Layer:
      return state.surface ? exactShader(state) : layerShaderOf(state);
    case Shadow:
      return state.closed > 0 ? Shader(luxo_closed_shadow_frag) : exactShader(state);
    case LayerShadow:
      return state.closed > 0 ? Shader(luxo_closed_layer_shadow_frag) : exactShader(state);
    case Transmittance:
    case LayerTransmittance:
    case MeshPlace:
    case LayerPlace:
      return exactShader(state);
    case ShadowsByRays:
      return luxo_ray_shadows_frag;
    case TransmittanceByRays:
      return luxo_ray_transmittance_frag;
    case LayersByRays:
      return luxo_ray_layers_frag;
    case FlatShadow:
      return withPattern(state, "pattern/flat_shadow.frag", luxo_flat_shadow_frag);
    case FlatTransmittance:
      return withPattern(state, "pattern/flat_transmittance.frag", luxo_flat_transmittance_frag);
    case LightDepth:
      return {};
    case LightMap:
      return luxo_light_map_frag;
    case LayerLightMap:
      return luxo_light_map_layer_frag;
    case Shade:
      return state.shadows ? withPattern(state, "pattern/shade_in_shadows.frag", luxo_shade_in_shadows_frag)
                           : withPattern(state, "pattern/shade.frag", luxo_shade_frag);
    case ShadeLayers:
      return withPattern(state, "pattern/shade_layers.frag", luxo_shade_layers_frag);
    case Openness:
      return luxo_openness_frag;
    case AddLight:
      return luxo_add_light_frag;
    case BlendLayers:
      return inspectionOf(state) ? Shader(luxo_inspect_layers_frag) : luxo_blend_layers_frag;
  }
  return {};
}

/// Views of geometry; wireframes; flat, Gouraud, Phong and toon shading.
Shader ScenePrograms::fragmentOfTriangles(const DrawState& state) {
  if (inspectionOf(state)) return luxo_inspect_frag;
  if (state.shading == Shading::Wireframe) return state.hidesLines ? Shader() : luxo_wireframe_frag;
  if (state.form == Form::FoundWithParameters) return foundShaderOf(state);
  if (state.shading == Shading::Gouraud) return withPattern(state, "pattern/gouraud.frag", luxo_gouraud_frag);
  if (state.shading == Shading::Toon) return withPattern(state, "pattern/toon.frag", luxo_toon_frag);
  return withPattern(state,
                     !state.pattern.readsFootprint() ? "pattern/surface.frag"
                     : state.byRays                  ? "pattern/ray_texture.frag"
                                                     : "pattern/texture.frag",
                     luxo_surface_frag);
}

Shader ScenePrograms::exactShader(const DrawState& state) const {
  return exactShaders_.at(exactShaderKey(state));
}

Shader ScenePrograms::withPattern(const DrawState& state, std::string_view name, Shader plain) {
  return state.pattern.valid() ? patternShader(state, name) : plain;
}

ScenePrograms::Shader ScenePrograms::patternShader(const DrawState& state, std::string_view name) {
  const Paint& pattern = state.pattern;
  const std::tuple key(pattern, name, state.tangents);
  const auto found = patternShaders_.find(key);
  if (found != patternShaders_.end()) return found->second;
  const std::string text = pattern.glsl();
  if (const auto builtIn = builtInPatternShader(name, text); !builtIn.empty())
    return patternShaders_.emplace(key, std::vector<std::uint32_t>(builtIn.begin(), builtIn.end()))
        .first->second;
  std::vector<gpu::ShaderSource> sources(std::begin(kShaderSources), std::end(kShaderSources));
  sources.push_back({"pattern", text});
  const auto source = std::ranges::find(kShaderSources, name, &gpu::ShaderSource::name);
  MaterialProgram::Joined material;
  if (pattern.shader()) {
    material = materials_.of(pattern.shader()).joined(pattern);
    const auto own = material.sources();
    sources.insert(sources.end(), own.begin(), own.end());
  }
  const std::string preamble = pattern.preamble() + (state.tangents ? "#define LUXO_VERTEX_TANGENTS\n" : "");
  auto shader = gpu::ShaderCompiler().compile({.source = *source, .includes = sources, .preamble = preamble});
  context_->counted().shadersCompiled += shader.compiled;
  return patternShaders_.emplace(key, std::move(shader.spirv)).first->second;
}

}  // namespace luxo
