// SPDX-License-Identifier: Apache-2.0
#include "draw/render_view.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <span>
#include <utility>

#include "draw/found_alike.h"

namespace luxo {
namespace {

/// Each number as the sum of two floats, one after the other. Without numbers one, to have something to bind.
std::vector<float> inPairs(const std::vector<double>& numbers) {
  if (numbers.empty()) return {0};
  std::vector<float> pairs;
  pairs.reserve(2 * numbers.size());
  for (const double number : numbers) {
    const auto high = static_cast<float>(number);
    pairs.push_back(high);
    pairs.push_back(static_cast<float>(number - high));
  }
  return pairs;
}

/// With a guard the picture is the middle of clip space (gpu::setViewport).
shared::ViewData guarded(shared::ViewData view, float guard) {
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 2; ++row) view.clipFromRelative[column][row] /= guard;
  return view;
}

/// A buffer has at least one element, so that there is something to bind.
template <class Element>
void writeElements(gpu::Context& context, MirroredBuffer& buffer, const std::vector<Element>& elements,
                   const char* name, bool always, VkBufferUsageFlags moreUsage = 0) {
  static const Element kNone{};
  const std::span<const Element> all(elements.empty() ? &kNone : elements.data(),
                                     std::max<std::size_t>(elements.size(), 1));
  buffer.write(context, std::as_bytes(all), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | moreUsage, name, always);
}

/// From one light set to the next.
std::size_t lightStride(const gpu::Context& context) {
  const auto alignment = std::max<std::size_t>(context.limits().minUniformBufferOffsetAlignment, 1);
  return (sizeof(shared::LightSet) + alignment - 1) / alignment * alignment;
}

/// Of such groups, a bit each.
std::uint32_t shadowSlots(const DrawList& list, const auto& isSuch) {
  std::uint32_t slots = 0;
  for (std::size_t i = 0; i < list.groups.size(); ++i)
    if (std::invoke(isSuch, list.groups[i])) slots |= 1U << list.shadowSlot(i);
  return slots;
}

/// Of the largest.
VkExtent2D extentOfLightMaps(const DrawList& list) {
  VkExtent2D extent{};
  for (const LightGroup& group : list.groups) {
    if (!group.map) continue;
    const std::uint32_t size = group.map->map.size, faces = group.map->map.faceCount,
                        row = std::min(faces, shared::kLightMapFacesInRow);
    extent.width = std::max(extent.width, row * size);
    extent.height = std::max(extent.height, faces / row * size);
  }
  return extent;
}

}  // namespace

RenderView::RenderView(gpu::Context& context, Precision precision)
    : context_(&context),
      targets_(context, precision),
      feedback_(context),
      layerLists_(context),
      traces_(context) {}

std::vector<Doubt> RenderView::doubts(const std::function<void(const Recording& record)>& submit) {
  const std::vector<OpenPixel> open = feedback_.open(list_.byRays, list_.shadowsByRays);
  if (open.empty()) return {};
  std::vector<PixelPlace> pixels;
  for (const OpenPixel& pixel : open) pixels.push_back(pixel.pixel);
  const bool ofMeshes = !list_.layerMeshes().empty() && std::ranges::any_of(open, &OpenPixel::layers);
  submit([&](VkCommandBuffer commands) {
    feedback_.recordShown(commands, targets_.texture(Target::Depth), picture(), pixels);
    if (ofMeshes) layerLists_.recordPoints(commands);
  });
  const std::vector<ShownDepth> shown = feedback_.shown(pixels);
  std::vector<Doubt> doubts;
  for (std::size_t i = 0; i < open.size(); ++i) {
    const auto& [pixel, point, shadows, layers, left] = open[i];
    doubts.push_back({.pixel = pixel,
                      .point = point || !shown[i].certified,
                      .shadows = shadows,
                      .layers = layers,
                      .shown = left || !shown[i].certified ? 0 : shown[i].depth});
  }
  if (ofMeshes) addMeshPoints(doubts);
  return doubts;
}

void RenderView::addMeshPoints(std::vector<Doubt>& doubts) {
  std::vector<PixelPlace> pixels;
  for (const Doubt& doubt : doubts) pixels.push_back(doubt.pixel);
  std::vector<std::vector<shared::LayerPoint>> points = layerLists_.pointsAt(pixels);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!doubts[i].layers) continue;
    std::erase_if(points[i], [](const shared::LayerPoint& point) {
      return (point.material & (shared::kLayerOfMesh | shared::kLayerOfSurface)) != shared::kLayerOfMesh;
    });
    doubts[i].meshes = std::move(points[i]);
  }
}

std::vector<DepthProbe> RenderView::probes() {
  std::vector<DepthProbe> probes = feedback_.depths();
  if (probes.empty() || !list_.layers.any()) return probes;
  const std::span<const std::byte> sums = layerLists_.sums().read();
  for (DepthProbe& probe : probes) {
    const std::size_t pixel = static_cast<std::size_t>(probe.pixel.y) * targets_.extent().width +
                              static_cast<std::size_t>(probe.pixel.x);
    std::memcpy(&probe.layers, sums.data() + pixel * sizeof probe.layers, sizeof probe.layers);
  }
  return probes;
}

ShownMeshes RenderView::shown() {
  if (list_.placed.empty()) return {};
  return {.nodes = list_.placed,
          .points = feedback_.shownPoints(),
          .width = static_cast<std::int32_t>(targets_.extent().width)};
}

shared::ShaderFaults RenderView::shaderFaults() {
  shared::ShaderFaults faults{};
  if (list_.runsShaders) std::memcpy(&faults, faults_.read().data(), sizeof faults);
  return faults;
}

bool RenderView::makeRoom() { return makeRoomForMore(0); }

bool RenderView::makeRoomFor(const RayPoints& points) { return makeRoomForMore(points.layerPoints.size()); }

bool RenderView::makeRoomForMore(std::size_t points) {
  const bool isMade = list_.layers.any() && layerLists_.makeRoom(points);
  if (isMade) recorded_.reset();
  return isMade;
}

LayerLists::Found RenderView::layerPoints() {
  const LayerLists::Found found = list_.layers.any() ? layerLists_.found() : LayerLists::Found{};
  if (found.missing > 0) recorded_.reset();
  return found;
}

void RenderView::begin(DrawList list, const DrawOptions& options, const VkClearColorValue& background,
                       VkExtent2D extent) {
  recorded_.reset();
  relit_ = false;
  list_ = std::move(list);
  options_ = options;
  background_ = background;
  hasRays_ = false;
  targets_.prepare(
      extent, static_cast<VkSampleCountFlagBits>(options.samples),
      {.deferred = list_.deferred,
       .footprints = list_.findsFootprints,
       .frames = list_.findsFrames,
       .openness = list_.occludes,
       .moreLight = list_.addsLight(),
       .shadows = shadowSlots(list_, [&](const LightGroup& group) { return list_.asksForShadows(group); }),
       .transmittances = shadowSlots(list_, &LightGroup::transmits),
       .places = list_.findsPlaces,
       .lightDepth = extentOfLightMaps(list_)});
  if (list_.layers.any()) layerLists_.prepare(extent, list_.layers.details, list_.shadowSlotCount());
  if (list_.traces) traces_.prepare(extent);
  if (list_.runsShaders && !faults_)
    faults_ = gpu::Buffer(*context_,
                          {.size = sizeof(shared::ShaderFaults),
                           .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                           .memory = gpu::MemoryUse::Readback,
                           .name = "faults of shaders"});
  feedback_.begin(list_, extent, chooseProbes());
  upload(!options_.skips.unchanged);
}

bool RenderView::hasFound(const Snapshot& snapshot, const DrawList& list, const DrawOptions& options,
                          const gpu::FrameRing& frames) const {
  return recorded_ && recorded_->frames == &frames && recorded_->thrownAway == frames.thrownAway() &&
         options_ == options && keepsWhatItFinds(list) && (!list.layers.any() || layerLists_.bands() == 1) &&
         findsAlike(recorded_->snapshot, snapshot) && findsAlike(list_, list);
}

void RenderView::recorded(const Snapshot& snapshot, const gpu::FrameRing& frames) {
  if (keepsWhatItFinds(list_)) recorded_ = {snapshot, &frames, frames.thrownAway()};
}

void RenderView::relight(DrawList list, const VkClearColorValue& background) {
  recorded_.reset();
  relit_ = true;
  list_ = std::move(list);
  background_ = background;
  feedback_.goOn();
  upload(!options_.skips.unchanged);
}

void RenderView::goOn(const RayPoints& points) {
  feedback_.goOn();
  hasRays_ = true;
  std::vector<shared::InstanceData> instances;
  for (const RayPoints::Run& run : points.runs) instances.push_back(list_.found[run.found].instance);
  if (instances.empty()) instances.resize(1);  // something to bind
  rayInstances_.write(*context_, std::as_bytes(std::span(instances)), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                      "instances of rays", false);
  const auto write = [&]<class Vertex>(MirroredBuffer& buffer, const std::vector<Vertex>& vertices,
                                       const char* name) {
    static const Vertex kNone{};
    const std::span<const Vertex> all(vertices.empty() ? &kNone : vertices.data(),
                                      std::max<std::size_t>(vertices.size(), 1));
    buffer.write(*context_, std::as_bytes(all), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, name, false);
  };
  write(rayVertices_, points.vertices, "points of rays");
  std::vector<RayShadow> shadows;
  for (const std::vector<RayShadow>& group : points.shadows)
    shadows.insert(shadows.end(), group.begin(), group.end());
  write(rayShadows_, shadows, "shadows of rays");
  write(rayLayers_, points.layers, "pixels of rays' layers");
  writeElements(*context_, rayLayerPoints_, points.layerPoints, "layers of rays", false);
  writeElements(*context_, rayLayerLights_, points.layerLights, "light on rays' layers", false);
  writeElements(*context_, rayLayerDetails_, points.layerDetails, "details of rays' layers", false);
}

void RenderView::upload(bool always) {
  const auto store = [&](MirroredBuffer& buffer, const auto& elements, const char* name) {
    writeElements(*context_, buffer, elements, name, always);
  };
  const shared::ViewData view = guarded(list_.view, targets_.guard());
  uploads_.view.write(*context_, std::as_bytes(std::span(&view, 1)), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT,
                      "view", always);
  writeElements(*context_, uploads_.instances, list_.instances, "instances", always,
                VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
  // As a uniform buffer it has room for as many as shaders say.
  std::vector<shared::MaterialData> materials = list_.materials;
  materials.resize(std::max<std::size_t>(materials.size(), shared::kUniformMaterials));
  uploads_.materials.write(*context_, std::as_bytes(std::span(materials)),
                           VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT,
                           "materials", always);
  const std::size_t stride = lightStride(*context_);
  std::vector<std::byte> lights(stride * list_.lightSets.size());
  for (std::size_t i = 0; i < list_.lightSets.size(); ++i)
    std::memcpy(lights.data() + i * stride, &list_.lightSets[i], sizeof(shared::LightSet));
  uploads_.lights.write(*context_, lights, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, "light sets", always);
  if (!list_.patternParameters.empty())
    store(uploads_.patternParameters, list_.patternParameters, "pattern parameters");
  uploadCasters(always);
  const auto index = [&](MirroredBuffer& buffer, const std::vector<std::uint32_t>& indices,
                         const char* name) {
    if (!indices.empty())
      buffer.write(*context_, std::as_bytes(std::span(indices)), VK_BUFFER_USAGE_INDEX_BUFFER_BIT, name,
                   always);
  };
  index(uploads_.clusterIndices, list_.clusterIndices, "indices of clusters");
  if (!list_.exact()) return;
  index(uploads_.shellIndices, list_.shellIndices, "shell indices");
  store(uploads_.exactInstances, list_.exactInstances, "exact instances");
  store(uploads_.exactPatches, list_.exactPatches, "patches");
  store(uploads_.exactParameters, inPairs(list_.exactParameters), "parameters of formulas");
}

void RenderView::uploadCasters(bool always) {
  const Casters& casters = list_.casters;
  if (!list_.looksForCasters()) return;
  const auto store = [&](MirroredBuffer& buffer, const auto& elements, const char* name) {
    writeElements(*context_, buffer, elements, name, always);
  };
  store(uploads_.casters, casters.casters, "casters");
  store(uploads_.meshPlaces, casters.meshes, "places of meshes");
  store(uploads_.closedCasters, casters.closed, "casters with equations");
  store(uploads_.gridStarts, casters.gridStarts, "texels of grids");
  store(uploads_.gridEntries, casters.gridEntries, "entries of grids");
  store(uploads_.casterCells, casters.cells, "cells of casters");
  store(uploads_.casterParameters, casters.parameters, "parameters of casters");
  // By group.
  std::vector<shared::LightMap> maps;
  for (const LightGroup& group : list_.groups)
    maps.push_back(group.map ? group.map->map : shared::LightMap{});
  store(uploads_.lightMaps, maps, "light maps");
}

RenderView::Bindings RenderView::bind(gpu::FrameRing& frames, ScenePipelines& pipelines, TexelStore& texels) {
  const auto sceneOf = [&](MirroredBuffer& instances) {
    return frames.descriptors().write(pipelines.layout(SceneSet::Scene),
                                      {uploads_.view.use(*context_),
                                       instances.use(*context_),
                                       {uploads_.lights.use(*context_), 0, sizeof(shared::LightSet)},
                                       uploads_.materials.use(*context_),
                                       list_.runsShaders ? faults_ : uploads_.materials.use(*context_)});
  };
  Bindings bindings{.scene = sceneOf(uploads_.instances), .instances = uploads_.instances.use(*context_)};
  if (!list_.patternParameters.empty())
    bindings.pattern = frames.descriptors().write(pipelines.layout(SceneSet::Pattern),
                                                  {uploads_.patternParameters.use(*context_)});
  if (!list_.textures.empty() && !list_.patternParameters.empty())
    bindTextures(frames, pipelines, texels.get(list_.textures), bindings);
  if (!list_.clusterIndices.empty()) bindings.clusterIndices = uploads_.clusterIndices.use(*context_);
  if (list_.exact()) {
    bindings.exact = frames.descriptors().write(
        pipelines.layout(SceneSet::Exact),
        {uploads_.exactInstances.use(*context_), uploads_.exactPatches.use(*context_),
         uploads_.exactParameters.use(*context_), feedback_.doubtful()});
    if (!list_.shellIndices.empty()) bindings.shellIndices = uploads_.shellIndices.use(*context_);
  }
  for (std::size_t i = 0; list_.deferred && i < list_.groups.size(); ++i)
    bindings.found.push_back(bindFound(frames, pipelines, i));
  if (list_.looksForCasters()) bindings.shadow = bindCasters(frames, pipelines, texels.get(list_.textures));
  for (std::size_t slot = 0; list_.layers.any() && slot < list_.shadowSlotCount(); ++slot)
    bindings.layers.push_back(bindLayers(frames, pipelines, slot));
  if (hasRays_) {
    bindings.sceneOfRays = sceneOf(rayInstances_);
    bindings.rayVertices = rayVertices_.use(*context_);
    bindings.rayShadows = rayShadows_.use(*context_);
    bindings.rayLayers = rayLayers_.use(*context_);
  }
  return bindings;
}

void RenderView::bindTextures(gpu::FrameRing& frames, ScenePipelines& pipelines, VkBufferView texels,
                              Bindings& bindings) {
  const gpu::Buffer& parameters = uploads_.patternParameters.use(*context_);
  bindings.texture = frames.descriptors().write(pipelines.layout(SceneSet::Texture), {parameters, texels});
  if (!list_.findsFootprints) return;
  gpu::Texture& footprints = targets_.texture(Target::FoundFootprint);
  gpu::Texture& frame = list_.findsFrames ? targets_.texture(Target::FoundFrame) : footprints;
  bindings.foundTexture = frames.descriptors().write(
      pipelines.layout(SceneSet::FoundTexture),
      {parameters, texels, {footprints, pipelines.texelSampler()}, {frame, pipelines.texelSampler()}});
}

/// Where the group's light does not ask for something, there is what was found, to have something to bind.
VkDescriptorSet RenderView::bindFound(gpu::FrameRing& frames, ScenePipelines& pipelines, std::size_t index) {
  constexpr VkDeviceSize kUniformBytes = shared::kUniformMaterials * sizeof(shared::MaterialData);
  const LightGroup& group = list_.groups[index];
  const auto textureOf = [&](bool isThere, Target target, std::size_t slot = 0) -> gpu::Texture& {
    return isThere ? targets_.texture(target, slot) : targets_.texture(Target::Found);
  };
  const std::size_t slot = list_.shadowSlot(index);
  const VkSampler sampler = pipelines.texelSampler();
  const gpu::Buffer& noTraces = uploads_.materials.use(*context_);
  return frames.descriptors().write(
      pipelines.layout(SceneSet::Found),
      {{targets_.texture(Target::Found), sampler},
       {textureOf(list_.findsParameters || list_.findsPlaces, Target::FoundParameters), sampler},
       {uploads_.materials.use(*context_), 0, kUniformBytes},
       {textureOf(list_.asksForShadows(group), Target::Shadows, slot), sampler},
       {textureOf(group.transmits, Target::Transmittance, slot), sampler},
       {textureOf(list_.findsShadows(), Target::Places), sampler},
       {textureOf(list_.occludes, Target::Openness), sampler},
       list_.traces ? traces_.questions() : noTraces,
       list_.traces ? traces_.starts() : noTraces,
       list_.traces ? traces_.answers() : noTraces,
       {textureOf(list_.addsLight(), Target::MoreLight), sampler}});
}

VkDescriptorSet RenderView::bindCasters(gpu::FrameRing& frames, ScenePipelines& pipelines,
                                        VkBufferView texels) {
  const gpu::Buffer& patterns = list_.patternParameters.empty() ? uploads_.casterParameters.use(*context_)
                                                                : uploads_.patternParameters.use(*context_);
  const gpu::Buffer& shown = list_.findsPlaces ? feedback_.shown() : feedback_.doubtful();
  gpu::Texture& depths = targets_.texture(list_.hasLightMaps() ? Target::LightDepth : Target::Depth);
  return frames.descriptors().write(pipelines.layout(SceneSet::Shadow),
                                    {uploads_.casters.use(*context_),
                                     uploads_.gridStarts.use(*context_),
                                     uploads_.gridEntries.use(*context_),
                                     uploads_.casterCells.use(*context_),
                                     uploads_.casterParameters.use(*context_),
                                     feedback_.doubtful(),
                                     patterns,
                                     uploads_.lightMaps.use(*context_),
                                     {depths, pipelines.texelSampler()},
                                     uploads_.closedCasters.use(*context_),
                                     uploads_.meshPlaces.use(*context_),
                                     shown,
                                     texels});
}

VkDescriptorSet RenderView::bindLayers(gpu::FrameRing& frames, ScenePipelines& pipelines, std::size_t slot) {
  constexpr VkDeviceSize kUniformBytes = shared::kUniformMaterials * sizeof(shared::MaterialData);
  const gpu::Buffer& byRays = hasRays_ ? rayLayerPoints_.use(*context_) : layerLists_.points();
  const gpu::Buffer& theirLight = hasRays_ ? rayLayerLights_.use(*context_) : layerLists_.points();
  const gpu::Buffer& theirDetails = hasRays_ ? rayLayerDetails_.use(*context_) : layerLists_.points();
  gpu::Texture& found = targets_.texture(list_.occludes ? Target::Found : Target::Depth);
  // Behind those of the first what adds points finds those of all.
  const VkDeviceSize begin = layerLists_.reachesOf(slot),
                     end = layerLists_.reachesOf(list_.shadowSlotCount());
  return frames.descriptors().write(pipelines.layout(SceneSet::Layers),
                                    {layerLists_.heads(),
                                     layerLists_.points(),
                                     layerLists_.count(),
                                     feedback_.doubtful(),
                                     {targets_.texture(Target::Depth), pipelines.texelSampler()},
                                     byRays,
                                     {uploads_.materials.use(*context_), 0, kUniformBytes},
                                     layerLists_.sums(),
                                     theirLight,
                                     layerLists_.details(),
                                     theirDetails,
                                     {found, pipelines.texelSampler()},
                                     {layerLists_.reaches(), begin, end - begin}});
}

std::uint32_t RenderView::lightOffset(std::uint32_t lightSet) const {
  return static_cast<std::uint32_t>(lightSet * lightStride(*context_));
}

std::vector<PixelPlace> RenderView::chooseProbes() const {
  const VkExtent2D extent = targets_.extent();
  if (!searches() || options_.samples != 1) return {};
  return auditedPixels({static_cast<int>(extent.width), static_cast<int>(extent.height)}, options_.audit,
                       list_.outlines);
}

}  // namespace luxo
