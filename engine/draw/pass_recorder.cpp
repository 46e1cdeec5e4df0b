// SPDX-License-Identifier: Apache-2.0
#include "draw/pass_recorder.h"

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

constexpr VkClearDepthStencilValue kInfinitelyFar{0.0f, 0};  // reversed

}  // namespace

void PassRecorder::record(const Pass& pass) {
  const gpu::Label label(context_, commands_, pass.name);
  useTargets(pass);
  begin(pass);
  for (const DrawBatch& batch : pass.batches) draw(batch);
  for (const ShadowDraw& shadow : pass.shadows) findShadow(shadow);
  for (const FlatShadowDraw& shadow : pass.flatShadows) flattenShadow(shadow);
  const bool ofShadows = pass.colors.front().target == Target::Shadows;
  if (pass.rays && ofShadows) drawShadows(*pass.rays, pass.group);
  if (pass.rays && !ofShadows) drawRays(*pass.rays);
  for (const DrawState& state : pass.shades) shade(state, view_.list().groups[pass.group]);
  vkCmdEndRendering(commands_);
  if (pass.probes && ofShadows)
    view_.feedback().recordShadowProbes(commands_, view_.targets().texture(Target::Shadows), pass.group);
  if (pass.probes && !ofShadows)
    view_.feedback().recordProbes(commands_, view_.targets().texture(Target::Depth));
  ++statistics_.count.passes;
}

void PassRecorder::useTargets(const Pass& pass) {
  using enum gpu::Use;
  ViewTargets& targets = view_.targets();
  std::vector<gpu::Usage> usages{{targets.texture(Target::Depth), DepthAttachment, contentsOf(pass.depth)}};
  for (const Attachment& color : pass.colors)
    usages.push_back({targets.texture(color.target), ColorAttachment, contentsOf(color.begin)});
  for (const Target target : pass.reads) usages.push_back({targets.texture(target), SampledFragment});
  if (gpu::Texture* resolved = targets.resolved())
    usages.push_back({*resolved, ResolveTarget, gpu::Contents::Discard});
  if (pass.searches) {
    usages.push_back({view_.feedback().lost(), StorageWrite});
    usages.push_back({view_.feedback().doubtful(), StorageWrite});
  }
  gpu::use(commands_, usages);
}

void PassRecorder::begin(const Pass& pass) {
  ViewTargets& targets = view_.targets();
  std::vector<VkRenderingAttachmentInfo> colors;
  for (const Attachment& attachment : pass.colors) {
    const bool isPicture = attachment.target == Target::Color;
    VkRenderingAttachmentInfo& color = colors.emplace_back(VkRenderingAttachmentInfo{
        .sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
        .imageView = targets.texture(attachment.target).view(),
        .imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
        .loadOp = loadOf(attachment.begin),
        .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
        .clearValue = {.color = isPicture ? view_.background() : VkClearColorValue{}}});
    if (!isPicture || !targets.resolved()) continue;
    color.resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT;
    color.resolveImageView = targets.resolved()->view();
    color.resolveImageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
  }
  const VkRenderingAttachmentInfo depth{.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                        .imageView = targets.texture(Target::Depth).view(),
                                        .imageLayout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL,
                                        .loadOp = loadOf(pass.depth),
                                        .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
                                        .clearValue = {.depthStencil = kInfinitelyFar}};
  const VkRenderingInfo rendering{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                                  .renderArea = {{0, 0}, targets.extent()},
                                  .layerCount = 1,
                                  .colorAttachmentCount = static_cast<std::uint32_t>(colors.size()),
                                  .pColorAttachments = colors.data(),
                                  .pDepthAttachment = &depth};
  vkCmdBeginRendering(commands_, &rendering);
  gpu::setViewport(commands_, targets.extent(), targets.guard());
}

void PassRecorder::draw(const DrawBatch& batch) {
  const gpu::GraphicsPipeline& pipeline = pipelines_.get(batch.state, view_.targets().format());
  const bool withParameters = readsParameters(batch.state);
  const DeviceMesh& mesh = batch.shell ? store_.get(batch.shell) : store_.get(batch.mesh, withParameters);
  const std::uint32_t lightOffset = view_.lightOffset(batch.lightSet);

  pipeline.bind(commands_);
  pipeline.bindSet(commands_, shared::kSetScene, bindings_.scene, {&lightOffset, 1});
  if (batch.state.pattern.valid()) pipeline.bindSet(commands_, shared::kSetPattern, bindings_.pattern);
  if (batch.shell) {
    pipeline.bindSet(commands_, shared::kSetExact, bindings_.exact);
    const ShellDraw draw{batch.half == Half::Far ? -1.0f : 1.0f, view_.targets().guard()};
    pipeline.push(commands_, std::as_bytes(std::span(&draw, 1)));
  }
  gpu::setDepthBias(commands_, biasOf(batch));
  vkCmdSetCullMode(commands_, cullMode(batch.culling));
  vkCmdSetFrontFace(commands_, batch.mirrored ? VK_FRONT_FACE_CLOCKWISE : VK_FRONT_FACE_COUNTER_CLOCKWISE);
  const VkBuffer streams[] = {mesh.vertices, withParameters ? mesh.parameters : mesh.vertices};
  constexpr VkDeviceSize kOffsets[] = {0, 0};
  vkCmdBindVertexBuffers(commands_, 0, withParameters ? 2 : 1, streams, kOffsets);
  if (batch.shell)
    vkCmdBindIndexBuffer(commands_, bindings_.shellIndices, 0, VK_INDEX_TYPE_UINT32);
  else
    vkCmdBindIndexBuffer(commands_, mesh.indices, 0, mesh.indexType);
  vkCmdDrawIndexed(commands_, batch.indexCount, batch.instanceCount, batch.firstIndex, 0,
                   batch.firstInstance);
  count(batch.instanceCount, batch.indexCount / 3, batch.vertexCount());
}

void PassRecorder::count(std::uint32_t instances, std::uint64_t triangles, std::uint64_t vertices) {
  ++statistics_.count.drawCalls;
  statistics_.count.instances += instances;
  statistics_.count.triangles += triangles * instances;
  statistics_.count.vertices += vertices * instances;
}

/// One triangle over all that was found.
void PassRecorder::shade(const DrawState& state, const LightGroup& group) {
  const gpu::GraphicsPipeline& pipeline = pipelines_.get(state, view_.targets().format());
  const std::uint32_t lightOffset = view_.lightOffset(group.lightSet);
  pipeline.bind(commands_);
  pipeline.bindSet(commands_, shared::kSetScene, bindings_.scene, {&lightOffset, 1});
  if (state.pattern.valid()) pipeline.bindSet(commands_, shared::kSetPattern, bindings_.pattern);
  pipeline.bindSet(commands_, shared::kSetFound, bindings_.found);
  drawWhole(0);
}

/// Where the caster may stand between the light and what was found.
void PassRecorder::findShadow(const ShadowDraw& draw) {
  const gpu::GraphicsPipeline& pipeline = pipelines_.get(draw.state, view_.targets().format());
  const std::uint32_t noLights = 0;
  pipeline.bind(commands_);
  pipeline.bindSet(commands_, shared::kSetScene, bindings_.scene, {&noLights, 1});
  pipeline.bindSet(commands_, shared::kSetShadow, bindings_.shadow);
  pipeline.bindSet(commands_, shared::kSetFound, bindings_.found);
  const PixelRect& area = draw.area;
  const VkRect2D scissor{{area.low.x, area.low.y},
                         {static_cast<std::uint32_t>(area.high.x - area.low.x),
                          static_cast<std::uint32_t>(area.high.y - area.low.y)}};
  vkCmdSetScissor(commands_, 0, 1, &scissor);
  drawWhole(draw.caster);
  ++statistics_.count.shadowPasses;
  gpu::setViewport(commands_, view_.targets().extent(), view_.targets().guard());
}

void PassRecorder::flattenShadow(const FlatShadowDraw& draw) {
  const gpu::GraphicsPipeline& pipeline =
      pipelines_.get({.form = Form::FlatShadow}, view_.targets().format());
  const DeviceMesh& mesh = store_.get(draw.mesh, false);
  shared::FlatShadow shadow = draw.shadow;
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 2; ++row) shadow.clipFromObject[column][row] /= view_.targets().guard();
  pipeline.bind(commands_);
  pipeline.bindSet(commands_, shared::kSetFound, bindings_.found);
  pipeline.push(commands_, std::as_bytes(std::span(&shadow, 1)));
  gpu::setDepthBias(commands_, {});
  vkCmdSetCullMode(commands_, VK_CULL_MODE_NONE);
  vkCmdSetFrontFace(commands_, VK_FRONT_FACE_COUNTER_CLOCKWISE);
  constexpr VkDeviceSize kOffset = 0;
  const VkBuffer vertices = mesh.vertices;
  vkCmdBindVertexBuffers(commands_, 0, 1, &vertices, &kOffset);
  vkCmdBindIndexBuffer(commands_, mesh.indices, 0, mesh.indexType);
  vkCmdDrawIndexed(commands_, mesh.indexCount, 1, 0, 0, 0);
  count(1, mesh.indexCount / 3, draw.mesh->positions.size());
  ++statistics_.count.shadowPasses;
}

void PassRecorder::drawWhole(std::uint32_t instance) {
  gpu::setDepthBias(commands_, {});
  vkCmdSetCullMode(commands_, VK_CULL_MODE_NONE);
  vkCmdSetFrontFace(commands_, VK_FRONT_FACE_COUNTER_CLOCKWISE);
  vkCmdDraw(commands_, 3, 1, 0, instance);
  count(1, 1, 3);
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
  const RayTarget target{Vec2f(extent.width, extent.height), view_.targets().guard()};
  std::uint32_t instance = 0;
  for (const RayPoints::Run& run : points.runs) {
    const FoundNode& node = view_.list().found[run.found];
    const gpu::GraphicsPipeline& pipeline = pipelines_.get(node.state, view_.targets().format());
    const std::uint32_t lightOffset = view_.lightOffset(node.lightSet);
    pipeline.bind(commands_);
    pipeline.bindSet(commands_, shared::kSetScene, bindings_.sceneOfRays, {&lightOffset, 1});
    if (node.state.pattern.valid()) pipeline.bindSet(commands_, shared::kSetPattern, bindings_.pattern);
    pipeline.push(commands_, std::as_bytes(std::span(&target, 1)));
    gpu::setDepthBias(commands_, {});
    vkCmdSetCullMode(commands_, VK_CULL_MODE_NONE);
    vkCmdSetFrontFace(commands_, VK_FRONT_FACE_COUNTER_CLOCKWISE);
    constexpr VkDeviceSize kOffset = 0;
    vkCmdBindVertexBuffers(commands_, 0, 1, &bindings_.rayVertices, &kOffset);
    vkCmdDraw(commands_, run.vertexCount, 1, run.firstVertex, instance++);
    count(1, run.vertexCount / 3, run.vertexCount);
  }
}

void PassRecorder::drawShadows(const RayPoints& points, std::size_t group) {
  if (points.shadows.empty()) return;
  const VkExtent2D extent = view_.targets().extent();
  const RayTarget target{Vec2f(extent.width, extent.height), view_.targets().guard()};
  const gpu::GraphicsPipeline& pipeline =
      pipelines_.get({.form = Form::ShadowsByRays}, view_.targets().format());
  pipeline.bind(commands_);
  pipeline.push(commands_, std::as_bytes(std::span(&target, 1)));
  gpu::setDepthBias(commands_, {});
  vkCmdSetCullMode(commands_, VK_CULL_MODE_NONE);
  vkCmdSetFrontFace(commands_, VK_FRONT_FACE_COUNTER_CLOCKWISE);
  constexpr VkDeviceSize kOffset = 0;
  vkCmdBindVertexBuffers(commands_, 0, 1, &bindings_.rayShadows, &kOffset);
  const auto vertices = static_cast<std::uint32_t>(points.shadows[group].size());
  vkCmdDraw(commands_, vertices, 1, static_cast<std::uint32_t>(group) * vertices, 0);
  count(1, vertices / 3, vertices);
}

}  // namespace luxo
