// SPDX-License-Identifier: Apache-2.0
#include "draw/scene_pipelines.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <span>

#include "base/error.h"
#include "draw/exact_shaders.h"
#include "draw/exact_source.h"
#include "draw/mesh_store.h"
#include "draw/ray_points.h"
#include "gpu/shader_compiler.h"
#include "luxo/shaders/exact_double_vert.h"
#include "luxo/shaders/exact_vert.h"
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
#include "luxo/shaders/inspect_vert.h"
#include "luxo/shaders/ray_found_footprint_frag.h"
#include "luxo/shaders/ray_found_frame_frag.h"
#include "luxo/shaders/ray_inspect_vert.h"
#include "luxo/shaders/ray_surface_frame_vert.h"
#include "luxo/shaders/ray_surface_pattern_vert.h"
#include "luxo/shaders/ray_surface_texture_vert.h"
#include "luxo/shaders/ray_surface_vert.h"
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
#include "luxo/shaders/wireframe_frag.h"
#include "luxo/shaders/wireframe_vert.h"

namespace luxo {
namespace {

struct Inspection {
  std::uint32_t quantity;
  bool asColor;
};

/// What a state shows of the geometry, if it shows geometry.
std::optional<Inspection> inspectionOf(const DrawState& state) {
  switch (state.output) {
    case Output::Position:
      return Inspection{shared::kPosition, false};
    case Output::Normal:
      return Inspection{shared::kNormal, false};
    case Output::Uv:
      return Inspection{shared::kParameters, false};
    case Output::Depth:
      return Inspection{shared::kDepth, false};
    case Output::Id:
      return Inspection{shared::kId, false};
    case Output::Residual:
      return Inspection{shared::kResidual, false};
    case Output::Certificate:
      return Inspection{shared::kCertificate, false};
    case Output::Color:
      break;
  }
  switch (state.shading) {
    case Shading::Normal:
      return Inspection{shared::kNormal, true};
    case Shading::Uv:
      return Inspection{shared::kParameters, true};
    case Shading::Depth:
      return Inspection{shared::kDepth, true};
    case Shading::Id:
      return Inspection{shared::kId, true};
    case Shading::Residual:
      return Inspection{shared::kResidual, true};
    default:
      return std::nullopt;
  }
}

/// Geometry is not seen through: the nearest surface counts, transparent or not.
void describeInspection(const DrawState& state, const Inspection& inspection,
                        gpu::GraphicsPipelineDesc& desc) {
  desc.vertexShader = luxo_inspect_vert;
  desc.fragmentShader = luxo_inspect_frag;
  desc.specialization = {{shared::kConstantQuantity, inspection.quantity},
                         {shared::kConstantAsColor, inspection.asColor},
                         {shared::kConstantCertificate, state.byRays      ? shared::kByRay
                                                        : state.isSurface ? shared::kBySearch
                                                                          : shared::kUncertified}};
  desc.depthWrite = true;
  desc.blend = gpu::Blend::None;
}

void describeWireframe(const DrawState& state, const gpu::Features& features,
                       gpu::GraphicsPipelineDesc& desc) {
  if (!features.fillModeNonSolid)
    throw Error(ErrorKind::Device, "this device cannot draw wireframes (no fillModeNonSolid)",
                "choose another shading or another --device");
  desc.vertexShader = luxo_wireframe_vert;
  desc.fragmentShader = luxo_wireframe_frag;
  desc.attributes.pop_back();
  desc.polygonMode = VK_POLYGON_MODE_LINE;
  desc.specialization.clear();
  if (!state.hidesLines) return;
  desc.fragmentShader = {};
  desc.polygonMode = VK_POLYGON_MODE_FILL;
  desc.blend = gpu::Blend::Keep;
}

/// Points that rays have found replace what is there.
void describeRayPoints(const DrawState& state, bool inspects, gpu::GraphicsPipelineDesc& desc) {
  const bool footprint = state.pattern.readsFootprint() || state.footprint;
  const bool frame = state.pattern.readsFrame() || state.frame;
  desc.vertexShader = inspects                 ? std::span<const std::uint32_t>(luxo_ray_inspect_vert)
                      : frame                  ? std::span<const std::uint32_t>(luxo_ray_surface_frame_vert)
                      : footprint              ? std::span<const std::uint32_t>(luxo_ray_surface_texture_vert)
                      : readsParameters(state) ? std::span<const std::uint32_t>(luxo_ray_surface_pattern_vert)
                                               : std::span<const std::uint32_t>(luxo_ray_surface_vert);
  desc.bindings = {{0, sizeof(RayPoint), VK_VERTEX_INPUT_RATE_VERTEX}};
  desc.attributes = {{0, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(RayPoint, position)},
                     {1, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(RayPoint, normal)},
                     {2, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(RayPoint, parameters)},
                     {3, 0, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(RayPoint, place)}};
  if (!readsParameters(state)) desc.attributes.erase(desc.attributes.begin() + 2);
  if (footprint && !inspects)
    desc.attributes.push_back({4, 0, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(RayPoint, footprint)});
  if (frame && !inspects)
    desc.attributes.push_back({5, 0, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(RayPoint, frame)});
  desc.depthCompare = VK_COMPARE_OP_ALWAYS;
  desc.pushConstantBytes = sizeof(RayTarget);
}

/// Of a mesh with its parameters.
std::span<const std::uint32_t> vertexShaderOf(const DrawState& state) {
  return state.tangents ? std::span<const std::uint32_t>(luxo_surface_tangent_vert)
                        : std::span<const std::uint32_t>(luxo_surface_pattern_vert);
}

/// Of triangles, or points of rays, that are lit later, with their parameters.
std::span<const std::uint32_t> foundShaderOf(const DrawState& state) {
  if (!state.footprint) return luxo_found_parameters_frag;
  if (state.byRays)
    return state.frame ? std::span<const std::uint32_t>(luxo_ray_found_frame_frag)
                       : std::span<const std::uint32_t>(luxo_ray_found_footprint_frag);
  return !state.frame     ? std::span<const std::uint32_t>(luxo_found_footprint_frag)
         : state.tangents ? std::span<const std::uint32_t>(luxo_found_tangent_frag)
                          : std::span<const std::uint32_t>(luxo_found_frame_frag);
}

/// Of triangles that are seen through.
std::span<const std::uint32_t> layerShaderOf(const DrawState& state) {
  return !state.details   ? std::span<const std::uint32_t>(luxo_surface_layer_frag)
         : state.tangents ? std::span<const std::uint32_t>(luxo_surface_layer_tangent_frag)
                          : std::span<const std::uint32_t>(luxo_surface_layer_frame_frag);
}

/// What a driver keeps of a pipeline whose shaders have that many bytes: measured on Mesa 22.3's lavapipe,
/// which compiles to machine code, 2.8 MB of 18 KB (toon), 3.0 of 22 (a pattern in phong), 5.2 to 7 of 98
/// (exact). Others keep less.
std::size_t bytesOf(const gpu::GraphicsPipelineDesc& desc) {
  constexpr std::size_t kAlways = std::size_t{2} << 20, kPerByte = 48;
  return kAlways + kPerByte * (desc.vertexShader.size_bytes() + desc.fragmentShader.size_bytes());
}

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

/// Fused, or found without parameters: one shader does both.
std::tuple<SurfaceCodePtr, Paint, bool, Form, bool, bool> exactShaderKey(const DrawState& state) {
  return {state.surface,   state.pattern, state.grazing, state.form == Form::Found ? Form::Fused : state.form,
          state.footprint, state.frame};
}

bool isFoundOnly(const DrawState& state) {
  return state.form == Form::Found || state.form == Form::FoundWithParameters;
}

bool isAgain(const DrawState& state) { return state.form == Form::Again || state.form == Form::LayerAgain; }

/// What fragments tell of their points, if no geometry is shown.
std::uint32_t quantityOf(const DrawState& state) {
  return isFoundOnly(state) ? shared::kFoundTexel : shared::kLight;
}

/// States that make the same pipeline become equal: an auxiliary output is the same under every shading, and
/// only one tells whether triangles are the surface.
DrawState canonical(DrawState state) {
  if (state.output != Output::Certificate) state.isSurface = false;
  if (state.output != Output::Color) state.shading = Shading::Phong;
  return state;
}

}  // namespace

bool readsParameters(const DrawState& state) {
  if (state.surface) return false;  // a shell has them among its vertices
  return inspectionOf(state).has_value() || state.pattern.valid() ||
         state.form == Form::FoundWithParameters || state.form == Form::Layer || isAgain(state);
}

ScenePipelines::ScenePipelines(gpu::Context& context)
    : context_(&context),
      sceneLayout_(context, {{.type = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER},
                             {.type = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
                             {.type = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC},
                             {.type = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER}}) {}

const gpu::GraphicsPipeline& ScenePipelines::get(const DrawState& wanted, const TargetFormat& format) {
  prepare({&wanted, 1}, format);
  Made& made = pipelines_.at({canonical(wanted), format});
  made.lastPicture = picture_;
  return made.pipeline;
}

void ScenePipelines::prepare(std::span<const DrawState> wanted, const TargetFormat& format) {
  std::vector<DrawState> states;
  for (const DrawState& state : wanted)
    if (!pipelines_.contains({canonical(state), format})) states.push_back(canonical(state));
  if (states.empty()) return;
  std::ranges::sort(states);
  states.erase(std::unique(states.begin(), states.end()), states.end());
  compileExactShaders(states);
  std::vector<gpu::GraphicsPipelineDesc> descs;
  for (const DrawState& state : states) descs.push_back(describe(state, format));
  std::vector<gpu::GraphicsPipeline> made = gpu::GraphicsPipeline::makeAll(*context_, descs);
  for (std::size_t i = 0; i < states.size(); ++i)
    pipelines_.emplace(std::pair{states[i], format}, Made{std::move(made[i]), bytesOf(descs[i]), picture_});
}

void ScenePipelines::beginPicture() {
  ++picture_;
  std::vector<decltype(pipelines_)::iterator> idle;
  std::size_t bytes = 0, used = 0;
  for (auto entry = pipelines_.begin(); entry != pipelines_.end(); ++entry) {
    if (entry->second.lastPicture + 2 >= picture_) {
      used += entry->second.bytes;
      continue;
    }
    idle.push_back(entry);
    bytes += entry->second.bytes;
  }
  const std::size_t most = std::max(kMaxIdlePipelineBytes, kMaxIdlePipelines * used);
  if (bytes <= most) return;
  std::ranges::stable_sort(idle, {}, [](const auto& entry) { return entry->second.lastPicture; });
  for (const auto& entry : idle) {
    if (bytes <= most) break;
    bytes -= entry->second.bytes;
    pipelines_.erase(entry);
  }
  forgetShaders();
}

void ScenePipelines::forgetShaders() {
  const auto isUsed = [this](const auto& uses) {
    return std::ranges::any_of(pipelines_, [&](const auto& entry) { return uses(entry.first.first); });
  };
  std::erase_if(exactShaders_, [&](const auto& shader) {
    return !isUsed(
        [&](const DrawState& state) { return state.surface && exactShaderKey(state) == shader.first; });
  });
  std::erase_if(patternShaders_, [&](const auto& shader) {
    return !isUsed([&](const DrawState& state) { return state.pattern == std::get<Paint>(shader.first); });
  });
}

const gpu::DescriptorLayout& ScenePipelines::patternLayout() {
  if (patternLayout_.bindings().empty())
    patternLayout_ = gpu::DescriptorLayout(*context_, {{.type = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER}});
  return patternLayout_;
}

const gpu::DescriptorLayout& ScenePipelines::textureLayout() {
  if (textureLayout_.bindings().empty())
    textureLayout_ = gpu::DescriptorLayout(
        *context_, {{.type = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
                    {VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, VK_SHADER_STAGE_FRAGMENT_BIT}});
  return textureLayout_;
}

const gpu::DescriptorLayout& ScenePipelines::foundTextureLayout() {
  if (foundTextureLayout_.bindings().empty())
    foundTextureLayout_ = gpu::DescriptorLayout(
        *context_, {{.type = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
                    {VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, VK_SHADER_STAGE_FRAGMENT_BIT},
                    {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_SHADER_STAGE_FRAGMENT_BIT},
                    {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_SHADER_STAGE_FRAGMENT_BIT}});
  return foundTextureLayout_;
}

const gpu::DescriptorLayout& ScenePipelines::paintLayout(const DrawState& state) {
  if (!state.pattern.readsFootprint()) return patternLayout();
  return state.form == Form::Shade ? foundTextureLayout() : textureLayout();
}

const gpu::DescriptorLayout& ScenePipelines::exactLayout() {
  if (exactLayout_.bindings().empty())
    exactLayout_ = gpu::DescriptorLayout(
        *context_, std::vector<gpu::DescriptorBinding>(shared::kExactBindings,
                                                       {.type = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER}));
  return exactLayout_;
}

const gpu::DescriptorLayout& ScenePipelines::foundLayout() {
  if (foundLayout_.bindings().empty())
    foundLayout_ = gpu::DescriptorLayout(
        *context_, {{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_SHADER_STAGE_FRAGMENT_BIT},
                    {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_SHADER_STAGE_FRAGMENT_BIT},
                    {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, VK_SHADER_STAGE_FRAGMENT_BIT},
                    {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_SHADER_STAGE_FRAGMENT_BIT},
                    {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_SHADER_STAGE_FRAGMENT_BIT},
                    {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_SHADER_STAGE_FRAGMENT_BIT},
                    {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_SHADER_STAGE_FRAGMENT_BIT},
                    {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_FRAGMENT_BIT},
                    {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_FRAGMENT_BIT},
                    {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_FRAGMENT_BIT}});
  return foundLayout_;
}

const gpu::DescriptorLayout& ScenePipelines::shadowLayout() {
  if (shadowLayout_.bindings().empty()) {
    std::vector<gpu::DescriptorBinding> bindings(shared::kShadowBindings,
                                                 {.type = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER});
    bindings[shared::kBindingLightDepths] = {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                                             VK_SHADER_STAGE_FRAGMENT_BIT};
    bindings[shared::kBindingCasterTexels] = {VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER,
                                              VK_SHADER_STAGE_FRAGMENT_BIT};
    shadowLayout_ = gpu::DescriptorLayout(*context_, bindings);
  }
  return shadowLayout_;
}

const gpu::DescriptorLayout& ScenePipelines::layersLayout() {
  if (layersLayout_.bindings().empty()) {
    std::vector<gpu::DescriptorBinding> bindings(shared::kLayerBindings,
                                                 {.type = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER});
    bindings[shared::kBindingLayerDepth] = {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                                            VK_SHADER_STAGE_FRAGMENT_BIT};
    bindings[shared::kBindingLayerMaterials] = {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
                                                VK_SHADER_STAGE_FRAGMENT_BIT};
    layersLayout_ = gpu::DescriptorLayout(*context_, bindings);
  }
  return layersLayout_;
}

VkSampler ScenePipelines::texelSampler() {
  if (!texelSampler_) texelSampler_ = gpu::createSampler(*context_, VK_FILTER_NEAREST);
  return texelSampler_;
}

void ScenePipelines::compileExactShaders(std::span<const DrawState> states) {
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
      static_cast<void>(programs_.of(shader));
  tbb::parallel_for(std::size_t{0}, missing.size(), [&](std::size_t i) {
    const auto& [surface, pattern, grazing, form, footprint, frame] = missing[i].key;
    const std::string_view patternText = pattern.valid() ? pattern.glsl() : "";
    const std::optional<ExactSource::Caster> caster = casterOf(form);
    const bool parameters = form == Form::FoundWithParameters;
    const auto builtIn = footprint ? std::span<const std::uint32_t>()
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
    std::string material;
    if (pattern.shader()) source.add(programs_.of(pattern.shader()).sources(pattern, material));
    missing[i].shader = gpu::ShaderCompiler().compile(source.desc());
  });
  for (Missing& m : missing) {
    context_->counted().shadersCompiled += m.shader.compiled;
    exactShaders_.emplace(std::move(m.key), std::move(m.shader.spirv));
  }
}

std::span<const std::uint32_t> ScenePipelines::casterShader(const DrawState& state) const {
  return exactShaders_.at(exactShaderKey(state));
}

void ScenePipelines::describeExact(const DrawState& state, const TargetFormat& format,
                                   gpu::GraphicsPipelineDesc& desc) {
  desc.vertexShader = state.surface->number == GlslNumber::Double
                          ? std::span<const std::uint32_t>(luxo_exact_double_vert)
                          : std::span<const std::uint32_t>(luxo_exact_vert);
  desc.fragmentShader = exactShaders_.at(exactShaderKey(state));
  desc.bindings = {{0, sizeof(ShellVertex), VK_VERTEX_INPUT_RATE_VERTEX}};
  desc.attributes = {{0, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(ShellVertex, position)},
                     {1, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(ShellVertex, parameters)},
                     {2, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(ShellVertex, cell)},
                     {3, 0, VK_FORMAT_R32_UINT, offsetof(ShellVertex, patch)}};
  const auto inspection = inspectionOf(state);
  desc.specialization = {{shared::kConstantPlainLights, state.plainLights},
                         {shared::kConstantShadedLights, state.shadedLights},
                         {shared::kConstantQuantity, inspection ? inspection->quantity : quantityOf(state)},
                         {shared::kConstantAsColor, inspection && inspection->asColor},
                         {shared::kConstantParameterCount, state.surface->parameters},
                         {shared::kConstantPoles, state.poles},
                         {shared::kConstantEquation, state.equation},
                         {shared::kConstantManySamples, format.samples != VK_SAMPLE_COUNT_1_BIT}};
  desc.depthClamp = true;
  desc.pushConstantBytes = sizeof(ShellDraw);
  static_assert(shared::kSetScene == 0 && shared::kSetPattern == 1 && shared::kSetExact == 2);
  desc.setLayouts = {sceneLayout_, paintLayout(state), exactLayout()};
}

const std::vector<std::uint32_t>& ScenePipelines::patternShader(const DrawState& state,
                                                                std::string_view name) {
  const Paint& pattern = state.pattern;
  const std::tuple key(pattern, name, state.tangents);
  const auto found = patternShaders_.find(key);
  if (found != patternShaders_.end()) return found->second;
  if (const auto builtIn = builtInPatternShader(name, pattern.glsl()); !builtIn.empty())
    return patternShaders_.emplace(key, std::vector<std::uint32_t>(builtIn.begin(), builtIn.end()))
        .first->second;
  std::vector<gpu::ShaderSource> sources(std::begin(kShaderSources), std::end(kShaderSources));
  sources.push_back({"pattern", pattern.glsl()});
  const auto source = std::ranges::find(kShaderSources, name, &gpu::ShaderSource::name);
  std::string material;
  if (pattern.shader()) {
    const auto own = programs_.of(pattern.shader()).sources(pattern, material);
    sources.insert(sources.end(), own.begin(), own.end());
  }
  const std::string preamble = pattern.preamble() + (state.tangents ? "#define LUXO_VERTEX_TANGENTS\n" : "");
  auto shader = gpu::ShaderCompiler().compile({.source = *source, .includes = sources, .preamble = preamble});
  context_->counted().shadersCompiled += shader.compiled;
  return patternShaders_.emplace(key, std::move(shader.spirv)).first->second;
}

/// Flat, Gouraud, Phong and toon.
void ScenePipelines::describeMesh(const DrawState& state, gpu::GraphicsPipelineDesc& desc) {
  const bool gouraud = state.shading == Shading::Gouraud, toon = state.shading == Shading::Toon;
  desc.vertexShader = gouraud ? std::span<const std::uint32_t>(luxo_gouraud_vert)
                      : toon  ? std::span<const std::uint32_t>(luxo_toon_vert)
                              : std::span<const std::uint32_t>(luxo_surface_vert);
  desc.fragmentShader = gouraud ? std::span<const std::uint32_t>(luxo_gouraud_frag)
                        : toon  ? std::span<const std::uint32_t>(luxo_toon_frag)
                                : std::span<const std::uint32_t>(luxo_surface_frag);
  if (!gouraud && !toon)
    desc.specialization.insert(desc.specialization.end(),
                               {{shared::kConstantFacetNormal, state.shading == Shading::Flat},
                                {shared::kConstantQuantity, quantityOf(state)}});
  if (state.form == Form::FoundWithParameters) {
    desc.vertexShader = vertexShaderOf(state);
    desc.fragmentShader = foundShaderOf(state);
  }
  if (state.form == Form::Layer) {
    desc.vertexShader = vertexShaderOf(state);
    desc.fragmentShader = layerShaderOf(state);
  }
  if (!state.pattern.valid()) return;
  desc.vertexShader =
      gouraud ? std::span<const std::uint32_t>(luxo_gouraud_pattern_vert) : vertexShaderOf(state);
  desc.fragmentShader = patternShader(state, gouraud                           ? "pattern/gouraud.frag"
                                             : toon                            ? "pattern/toon.frag"
                                             : !state.pattern.readsFootprint() ? "pattern/surface.frag"
                                             : state.byRays                    ? "pattern/ray_texture.frag"
                                                                               : "pattern/texture.frag");
}

/// The light on points that the same triangles have put down: as near as these are, where they are one a
/// pixel.
void ScenePipelines::describeAgain(const DrawState& state, gpu::GraphicsPipelineDesc& desc) {
  const bool gouraud = state.shading == Shading::Gouraud, layer = state.form == Form::LayerAgain;
  desc.vertexShader =
      gouraud ? std::span<const std::uint32_t>(luxo_gouraud_again_vert) : vertexShaderOf(state);
  if (state.pattern.valid())
    desc.fragmentShader =
        patternShader(state, gouraud ? (layer ? "pattern/gouraud_layer.frag" : "pattern/gouraud_again.frag")
                                     : (layer ? "pattern/toon_layer.frag" : "pattern/toon_again.frag"));
  else if (layer)
    desc.fragmentShader = gouraud ? std::span<const std::uint32_t>(luxo_gouraud_layer_frag)
                                  : std::span<const std::uint32_t>(luxo_toon_layer_frag);
  else
    desc.fragmentShader = gouraud ? std::span<const std::uint32_t>(luxo_gouraud_again_frag)
                                  : std::span<const std::uint32_t>(luxo_toon_again_frag);
  desc.specialization.insert(desc.specialization.end(), {{shared::kConstantFirstLight, state.firstLight},
                                                         {shared::kConstantExactShadows, state.exactShadows},
                                                         {shared::kConstantAddsLight, state.addsLight},
                                                         {shared::kConstantManyGroups, state.manyGroups},
                                                         {shared::kConstantTransmits, state.transmits}});
  desc.depthWrite = false;
  if (layer) return;
  desc.depthCompare = VK_COMPARE_OP_EQUAL;
  if (state.addsLight) desc.blend = gouraud ? gpu::Blend::Add : gpu::Blend::Lighten;
  desc.setLayouts = {sceneLayout_, paintLayout(state), foundLayout()};
}

gpu::GraphicsPipelineDesc ScenePipelines::describe(const DrawState& state, const TargetFormat& format) {
  gpu::GraphicsPipelineDesc desc{
      .name = nameOf(state.shading),
      .bindings = {{0, 2 * sizeof(Vec3f), VK_VERTEX_INPUT_RATE_VERTEX}},
      .attributes = {{0, 0, VK_FORMAT_R32G32B32_SFLOAT, 0},
                     {1, 0, VK_FORMAT_R32G32B32_SFLOAT, sizeof(Vec3f)}},
      .samples = format.samples,
      .colorFormats = {format.color},
      .depthFormat = format.depth,
      .depthWrite = !state.blended,
      .blend = state.blended && state.output == Output::Color ? gpu::Blend::Color : gpu::Blend::None,
      .specialization = {{shared::kConstantPlainLights, state.plainLights},
                         {shared::kConstantShadedLights, state.shadedLights}},
      .setLayouts = {sceneLayout_},
  };
  if (readsParameters(state)) {
    desc.bindings.push_back({1, sizeof(Vec2f), VK_VERTEX_INPUT_RATE_VERTEX});
    desc.attributes.push_back({2, 1, VK_FORMAT_R32G32_SFLOAT, 0});
  }
  if (state.tangents) {
    desc.bindings.push_back({2, sizeof(Vec4f), VK_VERTEX_INPUT_RATE_VERTEX});
    desc.attributes.push_back({5, 2, VK_FORMAT_R32G32B32A32_SFLOAT, 0});
  }
  if (isFoundOnly(state)) desc.colorFormats = {kFoundFormat};
  if (state.form == Form::FoundWithParameters) desc.colorFormats.push_back(kFoundParametersFormat);
  if (state.footprint) desc.colorFormats.push_back(kFoundFootprintFormat);
  if (state.frame) desc.colorFormats.push_back(kFoundFrameFormat);
  if (state.pattern.valid()) desc.setLayouts.push_back(paintLayout(state));
  const bool ofLayers = state.form == Form::Layer || state.form == Form::LayerPlace ||
                        state.form == Form::LayerShadow || state.form == Form::LayerTransmittance ||
                        state.form == Form::LayersByRays || state.form == Form::ShadeLayers ||
                        state.form == Form::BlendLayers || state.form == Form::LayerLightMap ||
                        state.form == Form::LayerAgain;
  if (ofLayers) {
    static_assert(shared::kSetLayers == 3);
    desc.setLayouts = {sceneLayout_,
                       state.surface || state.closed > 0 || state.form == Form::LayerLightMap
                           ? shadowLayout()
                           : paintLayout(state),
                       foundLayout(), layersLayout()};
    desc.depthFormat = VK_FORMAT_UNDEFINED;
    if (state.form != Form::BlendLayers) desc.colorFormats.clear();
  }
  if (isAgain(state)) {
    describeAgain(state, desc);
  } else if (ofLayers && (state.form != Form::Layer || state.surface)) {
    describeLayers(state, desc);
  } else if (state.form == Form::LightDepth) {
    describeLightDepth(desc);
  } else if (state.form == Form::Shade) {
    describeShade(state, desc);
  } else if (state.form == Form::Openness) {
    describeOpenness(desc);
  } else if (state.form == Form::MeshPlace) {
    describePlaces(state, desc);
  } else if (state.form == Form::Shadow || state.form == Form::Transmittance ||
             state.form == Form::ShadowsByRays || state.form == Form::TransmittanceByRays ||
             state.form == Form::FlatShadow || state.form == Form::FlatTransmittance ||
             state.form == Form::LightMap) {
    describeShadow(state, desc);
  } else if (state.surface) {
    describeExact(state, format, desc);
  } else if (const auto inspection = inspectionOf(state)) {
    describeInspection(state, *inspection, desc);
  } else if (state.shading == Shading::Wireframe) {
    describeWireframe(state, context_->features(), desc);
  } else {
    describeMesh(state, desc);
  }
  if (state.byRays) describeRayPoints(state, inspectionOf(state).has_value(), desc);
  return desc;
}

}  // namespace luxo
