// SPDX-License-Identifier: Apache-2.0
#include "draw/scene_pipelines.h"

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"
#include "draw/mesh_store.h"
#include "draw/ray_points.h"
#include "shared/scene_data.h"
#include "shell/shell.h"

namespace luxo {
namespace {

/// What a driver keeps of a pipeline whose shaders have that many bytes: measured on Mesa 22.3's lavapipe,
/// which compiles to machine code, 2.8 MB of 18 KB (toon), 3.0 of 22 (a pattern in phong), 5.2 to 7 of 98
/// (exact). Others keep less.
std::size_t bytesOf(const gpu::GraphicsPipelineDesc& desc) {
  constexpr std::size_t kAlways = std::size_t{2} << 20, kPerByte = 45;
  return kAlways + kPerByte * (desc.vertexShader.size_bytes() + desc.fragmentShader.size_bytes());
}

/// States that make the same pipeline become equal: an auxiliary output is the same under every shading, only
/// one tells whether triangles are the surface, and of what is seen through all ask how opaque it is.
DrawState canonical(DrawState state) {
  if (state.output != Output::Certificate) state.isSurface = false;
  if (state.output != Output::Color) state.shading = Shading::Phong;
  if (state.form == Form::ShadeLayers && state.output != Output::Color) state.output = Output::Depth;
  return state;
}

bool isTransversalSearch(const DrawState& state) {
  using enum Form;
  const bool searches = state.form == Fused || state.form == Found || state.form == FoundWithParameters;
  return searches && state.surface && !state.equation && !state.grazing;
}

std::string_view nameOfPipeline(const DrawState& state) {
  using enum Form;
  if (isOfLayers(state)) return "layers";
  switch (state.form) {
    case Shade:
      return "shade";
    case Openness:
      return "openness";
    case AddLight:
      return "more light";
    case MeshPlace:
      return "places";
    case LightDepth:
      return "light depth";
    case Fused:
    case Found:
    case FoundWithParameters:
    case Again:
      return nameOf(state.shading);
    default:
      return "shadow";
  }
}

/// All that any shader asks for.
std::vector<gpu::SpecializationConstant> constantsOf(const DrawState& state, const TargetFormat& targets) {
  const auto inspection = inspectionOf(state);
  return {{shared::kConstantPlainLights, state.plainLights},
          {shared::kConstantShadedLights, state.shadedLights},
          {shared::kConstantSpots, state.spots},
          {shared::kConstantFacetNormal, state.shading == Shading::Flat},
          {shared::kConstantQuantity, inspection           ? inspection->quantity
                                      : isFoundOnly(state) ? shared::kFoundTexel
                                                           : shared::kLight},
          {shared::kConstantAsColor, inspection && inspection->asColor},
          {shared::kConstantCertificate, state.byRays      ? shared::kByRay
                                         : state.isSurface ? shared::kBySearch
                                                           : shared::kUncertified},
          {shared::kConstantParameterCount, state.surface ? state.surface->parameters : 0},
          {shared::kConstantPoles, state.poles},
          {shared::kConstantWalks, state.walks},
          {shared::kConstantFrontOnly, state.frontOnly},
          {shared::kConstantEquation, state.equation},
          {shared::kConstantManySamples, targets.samples != VK_SAMPLE_COUNT_1_BIT},
          {shared::kConstantPattern, state.patternNumber},
          {shared::kConstantManyMaterials, state.manyMaterials},
          {shared::kConstantAddsLight, state.addsLight},
          {shared::kConstantManyGroups, state.manyGroups},
          {shared::kConstantTransmits, state.transmits},
          {shared::kConstantClosedCasters, state.closed},
          {shared::kConstantClosedKind, state.closedKind},
          {shared::kConstantFirstLight, state.firstLight},
          {shared::kConstantExactShadows, state.exactShadows},
          {shared::kConstantPlaces, state.places},
          {shared::kConstantOcclusion, state.occludes},
          {shared::kConstantGivenOrder, state.givenOrder},
          {shared::kConstantLayerDetails, state.details},
          {shared::kConstantCarries, !state.smallTriangles}};
}

/// What vertices of meshes are given of their instance.
void addInstance(gpu::GraphicsPipelineDesc& desc) {
  using shared::InstanceData;
  constexpr std::uint32_t kBinding = 3;
  desc.bindings.push_back({kBinding, sizeof(InstanceData), VK_VERTEX_INPUT_RATE_INSTANCE});
  const auto add = [&](std::uint32_t location, VkFormat format, std::size_t offset) {
    desc.attributes.push_back({location, kBinding, format, static_cast<std::uint32_t>(offset)});
  };
  for (std::uint32_t column = 0; column < 3; ++column) {
    add(shared::kAttributeRelativeFromObject + column, VK_FORMAT_R32G32B32A32_SFLOAT,
        offsetof(InstanceData, relativeFromObject) + column * sizeof(Vec4f));
    add(shared::kAttributeNormalFromObject + column, VK_FORMAT_R32G32B32_SFLOAT,
        offsetof(InstanceData, normalFromObject) + column * sizeof(Vec3f));
  }
  add(shared::kAttributeTranslation, VK_FORMAT_R32G32B32_SFLOAT, offsetof(InstanceData, translation));
  add(shared::kAttributeInstanceNumbers, VK_FORMAT_R32G32B32_UINT, offsetof(InstanceData, flags));
  add(shared::kAttributeDomain, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(InstanceData, domain));
}

/// What vertices there are: of a mesh, a shell, or what rays have found.
void setVertices(const DrawState& state, gpu::GraphicsPipelineDesc& desc) {
  constexpr VkFormat kFloat2 = VK_FORMAT_R32G32_SFLOAT, kFloat3 = VK_FORMAT_R32G32B32_SFLOAT,
                     kFloat4 = VK_FORMAT_R32G32B32A32_SFLOAT;
  const auto interleaved = [&](std::size_t bytes, std::vector<VkVertexInputAttributeDescription> attributes) {
    desc.bindings = {{0, static_cast<std::uint32_t>(bytes), VK_VERTEX_INPUT_RATE_VERTEX}};
    desc.attributes = std::move(attributes);
  };
  constexpr std::size_t kLight = offsetof(RayShadow, light);
  if (state.form == Form::ShadowsByRays || state.form == Form::TransmittanceByRays)
    interleaved(sizeof(RayShadow), {{shared::kAttributeShadowPlace, 0, kFloat2, offsetof(RayShadow, place)},
                                    {shared::kAttributeShadows, 0, VK_FORMAT_R32_UINT,
                                     kLight + offsetof(shared::ReachingLight, shadows)},
                                    {shared::kAttributeTransmittance, 0, kFloat3,
                                     kLight + offsetof(shared::ReachingLight, transmittance)}});
  else if (state.form == Form::LayersByRays)
    interleaved(sizeof(RayLayers),
                {{shared::kAttributeLayerPlace, 0, kFloat2, offsetof(RayLayers, place)},
                 {shared::kAttributeLayerRange, 0, VK_FORMAT_R32G32B32A32_UINT, offsetof(RayLayers, first)}});
  else if (state.byRays)
    interleaved(sizeof(RayPoint),
                {{shared::kAttributePosition, 0, kFloat3, offsetof(RayPoint, position)},
                 {shared::kAttributeNormal, 0, kFloat3, offsetof(RayPoint, normal)},
                 {shared::kAttributeParameters, 0, kFloat2, offsetof(RayPoint, parameters)},
                 {shared::kAttributePointPlace, 0, kFloat4, offsetof(RayPoint, place)},
                 {shared::kAttributePointFootprint, 0, kFloat4, offsetof(RayPoint, footprint)},
                 {shared::kAttributePointFrame, 0, kFloat4, offsetof(RayPoint, frame)},
                 {shared::kAttributePointFlags, 0, VK_FORMAT_R32_UINT, offsetof(RayPoint, flags)}});
  else if (state.surface)
    interleaved(sizeof(ShellVertex),
                {{shared::kAttributeShellPosition, 0, kFloat3, offsetof(ShellVertex, position)},
                 {shared::kAttributeShellParameters, 0, kFloat2, offsetof(ShellVertex, parameters)},
                 {shared::kAttributeShellCell, 0, kFloat3, offsetof(ShellVertex, cell)},
                 {shared::kAttributeShellPatch, 0, VK_FORMAT_R32_UINT, offsetof(ShellVertex, patch)}});
  else {
    desc.bindings = {{0, 2 * sizeof(Vec3f), VK_VERTEX_INPUT_RATE_VERTEX},
                     {1, sizeof(Vec2f), VK_VERTEX_INPUT_RATE_VERTEX},
                     {2, sizeof(Vec4f), VK_VERTEX_INPUT_RATE_VERTEX}};
    desc.attributes = {{shared::kAttributePosition, 0, kFloat3, 0},
                       {shared::kAttributeNormal, 0, kFloat3, sizeof(Vec3f)},
                       {shared::kAttributeParameters, 1, kFloat2, 0},
                       {shared::kAttributeTangent, 2, kFloat4, 0}};
    addInstance(desc);
  }
}

/// Which fragments of surfaces count: the nearest, and points that rays have found, which replace what is
/// there.
void setSurfaceFragments(const DrawState& state, gpu::GraphicsPipelineDesc& desc) {
  desc.depthWrite = !state.blended;
  if (state.surface) desc.depthClamp = true;
  if (state.byRays) desc.depthCompare = VK_COMPARE_OP_ALWAYS;
  if (!state.surface && inspectionOf(state)) {
    desc.depthWrite = true;  // the nearest surface counts, transparent or not
  } else if (state.shading == Shading::Wireframe) {
    if (state.hidesLines)
      desc.colorWrite = false;
    else
      desc.polygonMode = VK_POLYGON_MODE_LINE;
  }
}

/// Which fragments count.
void setFragments(const DrawState& state, gpu::GraphicsPipelineDesc& desc) {
  using enum Form;
  switch (state.form) {
    case Fused:
    case Found:
    case FoundWithParameters:
      setSurfaceFragments(state, desc);
      break;
    case Shade:
    case AddLight:
    case Openness:
    case MeshPlace:
    case Shadow:
    case Transmittance:
    case LightMap:
      // One triangle over all, as far as can be, has what is nearer than that: what has been found.
      desc.depthWrite = false;
      desc.depthCompare = VK_COMPARE_OP_LESS;
      break;
    case Again:  // as near as the points that the same triangles have put down, where they are one a pixel
      desc.depthWrite = false;
      desc.depthCompare = VK_COMPARE_OP_EQUAL;
      break;
    case FlatShadow:
    case FlatTransmittance:
    case ShadowsByRays:
    case TransmittanceByRays:
      desc.depthWrite = false;
      desc.depthCompare = VK_COMPARE_OP_ALWAYS;
      break;
    case LightDepth:
      desc.depthClamp = true;
      break;
    default:  // of layers: there is no depth
      break;
  }
}

void requireFeatures(const gpu::Features& features, const DrawState& state,
                     const gpu::GraphicsPipelineDesc& desc) {
  if (desc.polygonMode == VK_POLYGON_MODE_LINE && !features.fillModeNonSolid)
    throw Error(ErrorKind::Device, "this device cannot draw wireframes (no fillModeNonSolid)",
                "choose another shading or another --device");
  if (blendsBy(desc, gpu::Blend::Or) && !features.logicOp)
    throw Error(ErrorKind::Device, "this device cannot draw shadows (no logicOp)",
                "choose another --device, or set the lights' shadows to \"none\"");
  if (blendsBy(desc, gpu::Blend::Through) && !features.dualSrcBlend)
    throw Error(ErrorKind::Device, "this device cannot draw what is seen through (no dualSrcBlend)",
                "choose another --device");
  const bool layerOfTriangles =
      state.form == Form::LayerAgain || (state.form == Form::Layer && !state.surface);
  if (layerOfTriangles && !features.geometryShader)
    throw Error(ErrorKind::Device, "this device cannot draw meshes that are seen through (no geometryShader)",
                "choose another --device, or exact shading");
}

}  // namespace

const gpu::GraphicsPipeline& ScenePipelines::get(const DrawState& state, const TargetFormat& targets) {
  const Wanted wanted{canonical(state), targets};
  prepare({&wanted, 1});
  Made& made = pipelines_.at(wanted);
  made.lastPicture = picture_;
  return made.pipeline;
}

/// Of a formula that moves what is certain now is walked to, or grazed, later: none is to wait for a compiler
/// then.
std::array<ScenePipelines::Wanted, 2> ScenePipelines::otherSearches(const Wanted& transversal) {
  std::array others{transversal, transversal};
  others[0].state.walks = !transversal.state.walks;
  others[1].state.walks = others[1].state.grazing = true;
  return others;
}

void ScenePipelines::prepare(std::span<const Wanted> wanted) {
  std::vector<Wanted> missing;
  for (const Wanted& one : wanted) {
    Wanted key{canonical(one.state), one.targets};
    if (pipelines_.contains(key)) continue;
    if (isTransversalSearch(key.state))
      for (Wanted& other : otherSearches(key))
        if (!pipelines_.contains(other)) missing.push_back(std::move(other));
    missing.push_back(std::move(key));
  }
  if (missing.empty()) return;
  std::ranges::sort(missing);
  missing.erase(std::unique(missing.begin(), missing.end()), missing.end());
  std::vector<DrawState> states;
  for (const Wanted& one : missing) states.push_back(one.state);
  programs_.prepare(states);
  std::vector<gpu::GraphicsPipelineDesc> descs;
  std::vector<gpu::ShaderStages> stripped(missing.size());
  for (std::size_t i = 0; i < missing.size(); ++i) {
    gpu::GraphicsPipelineDesc& desc = descs.emplace_back(describe(missing[i]));
    if (!missing[i].state.smallTriangles) continue;
    stripped[i] = gpu::stripped(desc.vertexShader, desc.fragmentShader, desc.specialization);
    desc.vertexShader = stripped[i].vertex;
    desc.fragmentShader = stripped[i].fragment;
  }
  std::vector<gpu::GraphicsPipeline> made = gpu::GraphicsPipeline::makeAll(*context_, descs);
  for (std::size_t i = 0; i < missing.size(); ++i)
    pipelines_.emplace(std::move(missing[i]), Made{std::move(made[i]), bytesOf(descs[i]), picture_});
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
  std::vector<const DrawState*> states;
  for (const auto& entry : pipelines_) states.push_back(&entry.first.state);
  programs_.forgetAllBut(states);
}

VkSampler ScenePipelines::texelSampler() {
  if (!texelSampler_) texelSampler_ = gpu::createSampler(*context_, VK_FILTER_NEAREST);
  return texelSampler_;
}

gpu::GraphicsPipelineDesc ScenePipelines::describe(const Wanted& wanted) {
  const auto& [state, targets] = wanted;
  const ScenePrograms::Program program = programs_.of(state);
  gpu::GraphicsPipelineDesc desc{.name = nameOfPipeline(state),
                                 .vertexShader = program.vertex,
                                 .fragmentShader = program.fragment,
                                 .samples = targets.samples,
                                 .depthFormat = targets.depth,
                                 .specialization = constantsOf(state, targets),
                                 .setLayouts = layouts_.of(state)};
  for (const gpu::ColorAttachment& color : targets.colors)
    if (color.format != VK_FORMAT_UNDEFINED) desc.colors.push_back(color);
  setVertices(state, desc);
  setFragments(state, desc);
  requireFeatures(context_->features(), state, desc);
  return desc;
}

}  // namespace luxo
