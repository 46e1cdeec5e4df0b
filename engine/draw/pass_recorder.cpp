// SPDX-License-Identifier: Apache-2.0
#include "draw/pass_recorder.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "gpu/barrier.h"
#include "gpu/debug.h"

namespace luxo {
namespace {

/// A line is a pixel wide, so that its pixels are up to 0.5 beside the edge it is: that much deeper by the
/// slope of either triangle at it, along x and along y.
constexpr float kLineSlope = 1;

/// Vertices snap to 1/256 pixel, so the depth of a facet is uncertain by its slope times 1/512 pixel at its
/// edges; four times that, and a few units of rounding, keeps the halves of a surface apart wherever they
/// meet. Each half moves by its own slope, since either may be the steeper one.
gpu::DepthBias biasOf(const DrawBatch& batch) {
  constexpr float kUnits = 8, kSlope = 1.0f / 128;
  if (batch.state.hidesLines) return {.constant = -kUnits, .slope = -kLineSlope};
  if (batch.shell || batch.state.blended || batch.half == Half::Whole) return {};
  if (batch.half == Half::Far) return {.constant = -kUnits, .slope = -kSlope};
  return batch.twoSided ? gpu::DepthBias{.constant = kUnits, .slope = kSlope} : gpu::DepthBias{};
}

VkCullModeFlags cullMode(FaceCulling culling) {
  return culling == FaceCulling::None   ? VK_CULL_MODE_NONE
         : culling == FaceCulling::Back ? VK_CULL_MODE_BACK_BIT
                                        : VK_CULL_MODE_FRONT_BIT;
}

VkAttachmentLoadOp loadOf(Begin begin) {
  return begin == Begin::Clear ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD;
}

gpu::Contents contentsOf(Begin begin) {
  return begin == Begin::Clear ? gpu::Contents::Discard : gpu::Contents::Keep;
}

/// Rectangles that hold those pixels, one in each tile with some; all where there are none.
std::vector<PixelRect> areasAround(std::span<const RayShadow> pixels, const PixelRect& all) {
  constexpr std::int32_t kTile = 64;
  if (pixels.empty()) return {all};
  std::map<std::pair<std::int32_t, std::int32_t>, PixelRect> tiles;
  for (const RayShadow& pixel : pixels) {
    const auto x = static_cast<std::int32_t>(pixel.place.x), y = static_cast<std::int32_t>(pixel.place.y);
    PixelRect& area = tiles.try_emplace({x / kTile, y / kTile}, PixelRect{{x, y}, {x, y}}).first->second;
    area = {{std::min(area.low.x, x), std::min(area.low.y, y)},
            {std::max(area.high.x, x + 1), std::max(area.high.y, y + 1)}};
  }
  std::vector<PixelRect> areas;
  for (const auto& [tile, area] : tiles) areas.push_back(area);
  return areas;
}

constexpr VkClearDepthStencilValue kInfinitelyFar{0.0f, 0};  // reversed

}  // namespace

void PassRecorder::record(const Pass& pass) {
  const gpu::Label label(context_, commands_, pass.name);
  format_ = formatOf(pass, view_.targets().format());
  slot_ = view_.list().shadowSlot(pass.group);
  found_ = bindings_.found.empty() ? VK_NULL_HANDLE : bindings_.found[pass.group];
  layers_ = bindings_.layers.empty() ? VK_NULL_HANDLE : bindings_.layers[slot_];
  if (pass.clearsLayers) view_.layerLists().clear(commands_, pass.band.index);
  useTargets(pass);
  begin(pass);
  if (pass.drawsLightMap) drawLightMap(pass.group);
  for (const DrawBatch& batch : pass.batches) draw(batch);
  for (const CasterDraw& caster : pass.casters) search(caster);
  const std::optional<Target> target =
      pass.colors.empty() ? std::nullopt : std::optional(pass.colors.front().target);
  const bool ofShadows = target == Target::Shadows, ofTransmittance = target == Target::Transmittance;
  for (const FlatShadowDraw& shadow : pass.flatShadows) flattenShadow(shadow);
  if (pass.rays && (ofShadows || ofTransmittance))
    drawShadows(ofShadows ? Form::ShadowsByRays : Form::TransmittanceByRays, *pass.rays, pass.group);
  else if (pass.rays && pass.layers)
    drawLayers(*pass.rays, pass.group);
  else if (pass.rays)
    drawRays(*pass.rays);
  if (pass.readsLightMap) compareWithMap(pass.layers ? Form::LayerLightMap : Form::LightMap, pass.group);
  const std::vector<PixelRect> areas = areasAround(pass.pixels, rows_);
  for (const DrawState& state : pass.shades) shade(state, pass.group, areas);
  vkCmdEndRendering(commands_);
  if (pass.countsLayers) view_.layerLists().keepCount(commands_, pass.band.index);
  if (pass.probes && ofShadows)
    view_.feedback().recordShadowProbes(commands_, view_.targets().texture(Target::Shadows, slot_),
                                        pass.group);
  else if (pass.probes && ofTransmittance)
    view_.feedback().recordTransmittanceProbes(
        commands_, view_.targets().texture(Target::Transmittance, slot_), pass.group);
  else if (pass.probes)
    view_.feedback().recordProbes(commands_, view_.targets().texture(Target::Depth));
  ++statistics_.count.passes;
}

VkClearColorValue PassRecorder::clearOf(Target target) const {
  if (target == Target::Color) return view_.background();
  return target == Target::Transmittance ? VkClearColorValue{{1, 1, 1, 1}} : VkClearColorValue{};
}

void PassRecorder::useTargets(const Pass& pass) {
  using enum gpu::Use;
  ViewTargets& targets = view_.targets();
  std::vector<gpu::Usage> usages;
  if (pass.depth)
    usages.push_back({targets.texture(pass.depthTarget), DepthAttachment, contentsOf(*pass.depth)});
  if (pass.layers)
    for (gpu::Buffer* buffer : view_.layerLists().buffers()) usages.push_back({*buffer, StorageWrite});
  for (const Attachment& color : pass.colors)
    usages.push_back({targets.texture(color.target, slot_), ColorAttachment, contentsOf(color.begin)});
  for (const Target target : pass.reads) usages.push_back({targets.texture(target, slot_), SampledFragment});
  if (gpu::Texture* resolved = targets.resolved())
    usages.push_back({*resolved, ResolveTarget, gpu::Contents::Discard});
  if (view_.list().runsShaders) usages.push_back({view_.faults(), StorageWrite});
  if (pass.asks) usages.push_back({view_.traces().questions(), StorageWrite});
  if (pass.searches) {
    usages.push_back({view_.feedback().doubtful(), StorageWrite});
    if (view_.list().findsPlaces) usages.push_back({view_.feedback().shown(), StorageWrite});
  }
  gpu::use(commands_, usages);
}

void PassRecorder::begin(const Pass& pass) {
  ViewTargets& targets = view_.targets();
  std::vector<VkRenderingAttachmentInfo> colors;
  for (const Attachment& attachment : pass.colors) {
    const bool isPicture = attachment.target == Target::Color;
    VkRenderingAttachmentInfo& color = colors.emplace_back(
        VkRenderingAttachmentInfo{.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                  .imageView = targets.texture(attachment.target, slot_).view(),
                                  .imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                                  .loadOp = loadOf(attachment.begin),
                                  .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
                                  .clearValue = {.color = clearOf(attachment.target)}});
    if (!isPicture || !targets.resolved()) continue;
    color.resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT;
    color.resolveImageView = targets.resolved()->view();
    color.resolveImageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
  }
  const gpu::Texture& depths = targets.texture(pass.depthTarget);
  const VkExtent2D extent = depths.extent();
  const VkRenderingAttachmentInfo depth{.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                        .imageView = depths.view(),
                                        .imageLayout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL,
                                        .loadOp = loadOf(pass.depth.value_or(Begin::Keep)),
                                        .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
                                        .clearValue = {.depthStencil = kInfinitelyFar}};
  const VkRenderingInfo rendering{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                                  .renderArea = {{0, 0}, extent},
                                  .layerCount = 1,
                                  .colorAttachmentCount = static_cast<std::uint32_t>(colors.size()),
                                  .pColorAttachments = colors.data(),
                                  .pDepthAttachment = pass.depth ? &depth : nullptr};
  vkCmdBeginRendering(commands_, &rendering);
  gpu::setViewport(commands_, extent, pass.depthTarget == Target::Depth ? targets.guard() : 1);
  const auto width = static_cast<std::int32_t>(extent.width),
             height = static_cast<std::int32_t>(extent.height);
  // Even rows: a square of four fragments is of one band.
  const auto rowOf = [&](std::uint32_t band) {
    return band == pass.band.count
               ? height
               : static_cast<std::int32_t>(std::int64_t{height} * band / pass.band.count & ~std::int64_t{1});
  };
  rows_ = {{0, rowOf(pass.band.index)}, {width, rowOf(pass.band.index + 1)}};
  if (pass.band.count > 1) setScissor(rows_);
}

void PassRecorder::setScissor(const PixelRect& rect) {
  const VkRect2D scissor{{rect.low.x, rect.low.y},
                         {static_cast<std::uint32_t>(rect.high.x - rect.low.x),
                          static_cast<std::uint32_t>(rect.high.y - rect.low.y)}};
  vkCmdSetScissor(commands_, 0, 1, &scissor);
}

void PassRecorder::bindPaint(const gpu::GraphicsPipeline& pipeline, const DrawState& state) {
  if (!state.pattern.valid()) return;
  pipeline.bindSet(commands_, shared::kSetPattern,
                   !state.pattern.readsFootprint() ? bindings_.pattern
                   : state.form == Form::Shade     ? bindings_.foundTexture
                                                   : bindings_.texture);
}

void PassRecorder::draw(const DrawBatch& batch) {
  const gpu::GraphicsPipeline& pipeline = pipelines_.get(batch.state, format_);
  const bool withParameters = readsParameters(batch.state);
  const DeviceMesh& mesh =
      batch.shell ? store_.get(batch.shell) : store_.get(batch.mesh, withParameters, batch.state.tangents);
  const std::uint32_t lightOffset = view_.lightOffset(batch.lightSet);

  pipeline.bind(commands_);
  pipeline.bindSet(commands_, shared::kSetScene, bindings_.scene, {&lightOffset, 1});
  bindPaint(pipeline, batch.state);
  if (batch.state.form == Form::Layer || batch.state.form == Form::LayerAgain)
    pipeline.bindSet(commands_, shared::kSetLayers, layers_);
  if (batch.state.form == Form::Again) pipeline.bindSet(commands_, shared::kSetFound, found_);
  if (batch.shell) {
    pipeline.bindSet(commands_, shared::kSetExact, bindings_.exact);
    const shared::ShellDraw draw{batch.half == Half::Far ? -1.0f : 1.0f, view_.targets().guard()};
    pipeline.push(commands_, std::as_bytes(std::span(&draw, 1)));
  }
  gpu::setDepthBias(commands_, biasOf(batch));
  vkCmdSetCullMode(commands_, cullMode(batch.culling));
  vkCmdSetFrontFace(commands_, batch.mirrored ? VK_FRONT_FACE_CLOCKWISE : VK_FRONT_FACE_COUNTER_CLOCKWISE);
  // All bindings of scene_pipelines.cpp; what is not read may be anything.
  const VkBuffer streams[] = {mesh.vertices, withParameters ? mesh.parameters : mesh.vertices,
                              batch.state.tangents ? mesh.tangents : mesh.vertices, bindings_.instances};
  constexpr VkDeviceSize kOffsets[] = {0, 0, 0, 0};
  vkCmdBindVertexBuffers(commands_, 0, 4, streams, kOffsets);
  std::uint32_t draws = 1;
  if (batch.shell || batch.someClusters) {
    const VkBuffer indices = batch.shell ? bindings_.shellIndices : bindings_.clusterIndices;
    vkCmdBindIndexBuffer(commands_, indices, 0, VK_INDEX_TYPE_UINT32);
    vkCmdDrawIndexed(commands_, batch.indexCount, batch.instanceCount, batch.firstIndex, 0,
                     batch.firstInstance);
  } else {
    bindIndices(mesh);
    draws = drawWindows(mesh, {batch.firstIndex, batch.firstIndex + batch.indexCount},
                        {batch.firstInstance, batch.instanceCount});
  }
  count(draws, batch.instanceCount, batch.triangleCount(),
        std::min<std::size_t>(batch.vertexCount(), batch.indexCount));
}

void PassRecorder::bindIndices(const DeviceMesh& mesh) {
  vkCmdBindIndexBuffer(commands_, mesh.indices, 0,
                       mesh.windows.empty() ? VK_INDEX_TYPE_UINT32 : VK_INDEX_TYPE_UINT16);
}

std::uint32_t PassRecorder::drawWindows(const DeviceMesh& mesh, IndexRange range, InstanceRange instances) {
  const auto drawRange = [&](std::uint32_t first, std::uint32_t end, std::uint32_t firstVertex) {
    vkCmdDrawIndexed(commands_, end - first, instances.count, first, static_cast<std::int32_t>(firstVertex),
                     instances.first);
  };
  if (mesh.windows.empty()) {
    drawRange(range.first, range.end, 0);
    return 1;
  }
  std::uint32_t draws = 0;
  auto window = std::ranges::upper_bound(mesh.windows, range.first, {}, &IndexWindow::end);
  for (std::uint32_t first = range.first; first < range.end; first = (window++)->end, ++draws)
    drawRange(first, std::min(range.end, window->end), window->firstVertex);
  return draws;
}

void PassRecorder::drawAll(const DeviceMesh& mesh, std::size_t vertices) {
  bindIndices(mesh);
  count(drawWindows(mesh, {0, mesh.indexCount}, {0, 1}), 1, mesh.indexCount / 3, vertices);
}

void PassRecorder::count(std::uint32_t draws, std::uint32_t instances, std::uint64_t triangles,
                         std::uint64_t vertices) {
  statistics_.count.drawCalls += draws;
  statistics_.count.instances += instances;
  statistics_.count.triangles += triangles * instances;
  statistics_.count.vertices += vertices * instances;
}

/// One triangle over all that was found there.
void PassRecorder::shade(const DrawState& state, std::size_t group, std::span<const PixelRect> areas) {
  const gpu::GraphicsPipeline& pipeline = pipelines_.get(state, format_);
  // What blends layers asks for no light.
  const std::vector<LightGroup>& groups = view_.list().groups;
  const std::uint32_t lightOffset = groups.empty() ? 0 : view_.lightOffset(groups[group].lightSet);
  pipeline.bind(commands_);
  pipeline.bindSet(commands_, shared::kSetScene, bindings_.scene, {&lightOffset, 1});
  bindPaint(pipeline, state);
  if (state.form == Form::Shade || state.form == Form::Openness || state.form == Form::AddLight)
    pipeline.bindSet(commands_, shared::kSetFound, found_);
  else
    pipeline.bindSet(commands_, shared::kSetLayers, layers_);
  for (const PixelRect& area : areas) {
    setScissor(area);
    drawWhole(0);
  }
  setScissor(rows_);
}

/// Where the caster may stand between the light and what was found; or where it may be seen.
void PassRecorder::search(const CasterDraw& draw) {
  const PixelRect area{{draw.area.low.x, std::max(draw.area.low.y, rows_.low.y)},
                       {draw.area.high.x, std::min(draw.area.high.y, rows_.high.y)}};
  if (area.low.y >= area.high.y) return;
  const Form form = draw.state.form;
  const bool ofLayers = form != Form::MeshPlace && form != Form::Shadow && form != Form::Transmittance;
  const gpu::GraphicsPipeline& pipeline = pipelines_.get(draw.state, format_);
  const std::uint32_t noLights = 0;
  pipeline.bind(commands_);
  pipeline.bindSet(commands_, shared::kSetScene, bindings_.scene, {&noLights, 1});
  pipeline.bindSet(commands_, shared::kSetShadow, bindings_.shadow);
  if (ofLayers)
    pipeline.bindSet(commands_, shared::kSetLayers, layers_);
  else
    pipeline.bindSet(commands_, shared::kSetFound, found_);
  setScissor(area);
  drawWhole(draw.caster);
  if (form != Form::Layer && form != Form::MeshPlace && form != Form::LayerPlace)
    statistics_.count.shadowPasses += std::max(draw.state.closed, 1U);
  setScissor(rows_);
}

void PassRecorder::flattenShadow(const FlatShadowDraw& draw) {
  const gpu::GraphicsPipeline& pipeline = pipelines_.get(draw.state, format_);
  const bool withParameters = draw.state.pattern.valid();
  const DeviceMesh& mesh = store_.get(draw.mesh, withParameters);
  struct {
    shared::FlatShadow shadow;
    shared::FlatPattern caster;
  } pushed{draw.shadow, draw.caster};
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 2; ++row) pushed.shadow.clipFromObject[column][row] /= view_.targets().guard();
  pipeline.bind(commands_);
  bindPaint(pipeline, draw.state);
  pipeline.bindSet(commands_, shared::kSetFound, found_);
  pipeline.push(commands_, std::as_bytes(std::span(&pushed, 1)));
  vkCmdSetCullMode(commands_, VK_CULL_MODE_NONE);
  vkCmdSetFrontFace(commands_, VK_FRONT_FACE_COUNTER_CLOCKWISE);
  const VkBuffer streams[] = {mesh.vertices, withParameters ? mesh.parameters : mesh.vertices};
  constexpr VkDeviceSize kOffsets[] = {0, 0};
  vkCmdBindVertexBuffers(commands_, 0, withParameters ? 2 : 1, streams, kOffsets);
  drawAll(mesh, draw.mesh->positions.size());
  ++statistics_.count.shadowPasses;
}

/// Its faces, three in a row.
void PassRecorder::drawLightMap(std::size_t group) {
  const LightMapDrawn& drawn = *view_.list().groups[group].map;
  const gpu::GraphicsPipeline& pipeline = pipelines_.get({.form = Form::LightDepth}, format_);
  pipeline.bind(commands_);
  vkCmdSetCullMode(commands_, VK_CULL_MODE_NONE);
  vkCmdSetFrontFace(commands_, VK_FRONT_FACE_COUNTER_CLOCKWISE);
  const std::uint32_t size = drawn.map.size;
  for (std::uint32_t face = 0; face < drawn.map.faceCount; ++face) {
    const VkOffset2D corner{static_cast<std::int32_t>(face % shared::kLightMapFacesInRow * size),
                            static_cast<std::int32_t>(face / shared::kLightMapFacesInRow * size)};
    gpu::setViewport(commands_, VkRect2D{corner, {size, size}});
    for (const LightMapDrawn::Caster& caster : drawn.casters) drawIntoMap(pipeline, caster, face);
  }
}

void PassRecorder::drawIntoMap(const gpu::GraphicsPipeline& pipeline, const LightMapDrawn::Caster& caster,
                               std::uint32_t face) {
  const DeviceMesh& mesh = store_.get(caster.mesh, false);
  pipeline.push(commands_, std::as_bytes(std::span(&caster.clipFromObject[face], 1)));
  constexpr VkDeviceSize kOffset = 0;
  const VkBuffer vertices = mesh.vertices;
  vkCmdBindVertexBuffers(commands_, 0, 1, &vertices, &kOffset);
  drawAll(mesh, caster.mesh->positions.size());
  ++statistics_.count.shadowPasses;
}

/// On all points that were found, or that are seen through.
void PassRecorder::compareWithMap(Form form, std::size_t group) {
  const gpu::GraphicsPipeline& pipeline = pipelines_.get({.form = form}, format_);
  const std::uint32_t noLights = 0;
  pipeline.bind(commands_);
  pipeline.bindSet(commands_, shared::kSetScene, bindings_.scene, {&noLights, 1});
  pipeline.bindSet(commands_, shared::kSetShadow, bindings_.shadow);
  if (form == Form::LightMap)
    pipeline.bindSet(commands_, shared::kSetFound, found_);
  else
    pipeline.bindSet(commands_, shared::kSetLayers, layers_);
  drawWhole(static_cast<std::uint32_t>(group));
}

void PassRecorder::drawWhole(std::uint32_t instance) {
  vkCmdSetCullMode(commands_, VK_CULL_MODE_NONE);
  vkCmdSetFrontFace(commands_, VK_FRONT_FACE_COUNTER_CLOCKWISE);
  vkCmdDraw(commands_, 3, 1, 0, instance);
  count(1, 1, 1, 3);
}

void PassRecorder::clearMisses(std::span<const PixelPlace> misses) {
  std::vector<VkClearRect> empty;  // runs of pixels in a row
  for (const PixelPlace& pixel : misses) {
    if (!empty.empty()) {
      VkRect2D& last = empty.back().rect;
      if (last.offset.y == pixel.y &&
          last.offset.x + static_cast<std::int32_t>(last.extent.width) == pixel.x) {
        ++last.extent.width;
        continue;
      }
    }
    empty.push_back({.rect = {{pixel.x, pixel.y}, {1, 1}}, .layerCount = 1});
  }
  if (empty.empty()) return;
  const VkClearColorValue nothing = view_.list().deferred ? VkClearColorValue{} : view_.background();
  const VkClearAttachment cleared[] = {
      {.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .clearValue = {.color = nothing}},
      {.aspectMask = VK_IMAGE_ASPECT_DEPTH_BIT, .clearValue = {.depthStencil = kInfinitelyFar}}};
  vkCmdClearAttachments(commands_, 2, cleared, static_cast<std::uint32_t>(empty.size()), empty.data());
}

void PassRecorder::drawRays(const RayPoints& points) {
  clearMisses(points.misses);
  const VkExtent2D extent = view_.targets().extent();
  const shared::RayTarget target{Vec2f(extent.width, extent.height), view_.targets().guard()};
  std::uint32_t instance = 0;
  for (const RayPoints::Run& run : points.runs) {
    const FoundNode& node = view_.list().found[run.found];
    const gpu::GraphicsPipeline& pipeline = pipelines_.get(node.state, format_);
    const std::uint32_t lightOffset = view_.lightOffset(node.lightSet);
    pipeline.bind(commands_);
    pipeline.bindSet(commands_, shared::kSetScene, bindings_.sceneOfRays, {&lightOffset, 1});
    bindPaint(pipeline, node.state);
    pipeline.push(commands_, std::as_bytes(std::span(&target, 1)));
    vkCmdSetCullMode(commands_, VK_CULL_MODE_NONE);
    vkCmdSetFrontFace(commands_, VK_FRONT_FACE_COUNTER_CLOCKWISE);
    constexpr VkDeviceSize kOffset = 0;
    vkCmdBindVertexBuffers(commands_, 0, 1, &bindings_.rayVertices, &kOffset);
    vkCmdDraw(commands_, run.vertexCount, 1, run.firstVertex, instance++);
    count(1, 1, run.vertexCount / 3, run.vertexCount);
  }
}

void PassRecorder::drawShadows(Form form, const RayPoints& points, std::size_t group) {
  if (points.shadows.empty()) return;
  const auto count = static_cast<std::uint32_t>(points.shadows[group].size());
  drawTriangles({.form = form}, bindings_.rayShadows, static_cast<std::uint32_t>(group) * count, count);
}

void PassRecorder::drawLayers(const RayPoints& points, std::size_t group) {
  drawTriangles({.form = Form::LayersByRays, .details = view_.list().layers.details}, bindings_.rayLayers, 0,
                static_cast<std::uint32_t>(points.layers.size()), static_cast<std::uint32_t>(group));
}

/// Triangles that cover a pixel each.
void PassRecorder::drawTriangles(const DrawState& state, VkBuffer vertices, std::uint32_t first,
                                 std::uint32_t vertexCount, std::uint32_t instance) {
  if (vertexCount == 0) return;
  const gpu::GraphicsPipeline& pipeline = pipelines_.get(state, format_);
  pipeline.bind(commands_);
  if (state.form == Form::LayersByRays) {
    const std::uint32_t noLights = 0;
    pipeline.bindSet(commands_, shared::kSetScene, bindings_.scene, {&noLights, 1});
    pipeline.bindSet(commands_, shared::kSetLayers, layers_);
  }
  const VkExtent2D extent = view_.targets().extent();
  const shared::RayTarget target{Vec2f(extent.width, extent.height), view_.targets().guard()};
  pipeline.push(commands_, std::as_bytes(std::span(&target, 1)));
  vkCmdSetCullMode(commands_, VK_CULL_MODE_NONE);
  vkCmdSetFrontFace(commands_, VK_FRONT_FACE_COUNTER_CLOCKWISE);
  constexpr VkDeviceSize kOffset = 0;
  vkCmdBindVertexBuffers(commands_, 0, 1, &vertices, &kOffset);
  vkCmdDraw(commands_, vertexCount, 1, first, instance);
  count(1, 1, vertexCount / 3, vertexCount);
}

}  // namespace luxo
