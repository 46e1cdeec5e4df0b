// SPDX-License-Identifier: Apache-2.0
#include "draw/scene_painter.h"

#include <algorithm>
#include <chrono>
#include <cstring>

#include "gpu/barrier.h"
#include "gpu/debug.h"

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

class Stopwatch {
 public:
  /// Milliseconds since the start or the last lap.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const std::chrono::duration<double, std::milli> elapsed = now - start_;
    start_ = now;
    return elapsed.count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

CullOptions cullOptions(const DrawOptions& options, int samples) {
  return {.tolerancePx = options.tolerancePx,
          .samples = samples,
          .shading = options.shading,
          .frustum = options.skips.frustum,
          .small = options.skips.small,
          .backface = options.skips.backface,
          .lights = options.skips.lights};
}

void addCounts(FrameCounts& to, const CullCounts& from) {
  to.nodes += from.nodes;
  to.drawn += from.drawn;
  to.culledFrustum += from.culledFrustum;
  to.culledSmall += from.culledSmall;
  to.culledBackface += from.culledBackface;
  to.culledLights += from.culledLights;
}

/// What stands where nothing is drawn.
VkClearColorValue backgroundOf(const Snapshot& snapshot, Output output) {
  const float infinity = std::numeric_limits<float>::infinity();
  const Vec3f b(snapshot.background);
  if (output == Output::Color) return {{b.x, b.y, b.z, 0}};
  return {{output == Output::Depth ? infinity : 0.0f, 0, 0, 0}};
}

/// How many times as large as the picture the viewport is, where the device allows. Triangles that reach past
/// a viewport are cut into slivers, of which a CPU device rounds the slopes: a tenth of a pixel is lost of
/// what a mesh interpolates. Those that leave the picture by less than half of it are not cut.
float guardOf(VkExtent2D extent, const VkPhysicalDeviceLimits& limits) {
  constexpr std::uint32_t kGuard = 2;
  const bool fits = kGuard * extent.width <= limits.maxViewportDimensions[0] &&
                    kGuard * extent.height <= limits.maxViewportDimensions[1];
  return fits ? kGuard : 1;
}

shared::ViewData guarded(shared::ViewData view, float guard) {
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 2; ++row) view.clipFromRelative[column][row] /= guard;
  return view;
}

struct PassTargets {
  gpu::Texture& color;
  gpu::Texture* resolved;  ///< averaged into at the end of the pass; null without multisampling
  gpu::Texture& depth;
};

void beginPass(VkCommandBuffer commands, const PassTargets& targets, VkAttachmentLoadOp load,
               VkClearColorValue background, float guard) {
  VkRenderingAttachmentInfo color{.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                  .imageView = targets.color.view(),
                                  .imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                                  .loadOp = load,
                                  .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
                                  .clearValue = {.color = background}};
  if (targets.resolved) {
    color.resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT;
    color.resolveImageView = targets.resolved->view();
    color.resolveImageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
  }
  const VkRenderingAttachmentInfo depth{
      .sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
      .imageView = targets.depth.view(),
      .imageLayout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL,
      .loadOp = load,
      .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
      .clearValue = {.depthStencil = {0.0f, 0}}};  // reversed: 0 is infinitely far
  const VkRenderingInfo rendering{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                                  .renderArea = {{0, 0}, targets.color.extent()},
                                  .layerCount = 1,
                                  .colorAttachmentCount = 1,
                                  .pColorAttachments = &color,
                                  .pDepthAttachment = &depth};
  vkCmdBeginRendering(commands, &rendering);
  gpu::setViewport(commands, targets.color.extent(), guard);
}

/// Vertices snap to 1/256 pixel, so the depth of a facet is uncertain by its slope times 1/512 pixel at its
/// edges; four times that, and a few units of rounding, keeps the halves of a surface apart wherever they
/// meet. Each half moves by its own slope, since either may be the steeper one.
gpu::DepthBias biasOf(const DrawBatch& batch) {
  constexpr float kUnits = 8, kSlope = 1.0f / 128;
  if (batch.hull || batch.state.blended || batch.half == Half::Whole) return {};
  if (batch.half == Half::Far) return {.constant = -kUnits, .slope = -kSlope};
  return batch.twoSided ? gpu::DepthBias{.constant = kUnits, .slope = kSlope} : gpu::DepthBias{};
}

VkCullModeFlags cullMode(FaceCulling culling) {
  return culling == FaceCulling::None   ? VK_CULL_MODE_NONE
         : culling == FaceCulling::Back ? VK_CULL_MODE_BACK_BIT
                                        : VK_CULL_MODE_FRONT_BIT;
}

}  // namespace

ScenePainter::ScenePainter(gpu::Context& context, Precision precision)
    : context_(&context), pipelines_(context), store_(context) {
  format_.color =
      precision == Precision::Full ? VK_FORMAT_R32G32B32A32_SFLOAT : VK_FORMAT_R16G16B16A16_SFLOAT;
  const VkDeviceSize alignment = std::max<VkDeviceSize>(context.limits().minUniformBufferOffsetAlignment, 1);
  lightStride_ = (sizeof(shared::LightSet) + alignment - 1) / alignment * alignment;
}

void ScenePainter::record(gpu::FrameRing& frames, VkCommandBuffer commands, const Snapshot& scene,
                          const DrawOptions& options, FrameStatistics& statistics, const SearchCare& care) {
  const bool auxiliary = options.output != Output::Color;
  const VkSampleCountFlagBits samples =
      auxiliary ? VK_SAMPLE_COUNT_1_BIT
                : context_->supportedSamples(static_cast<std::uint32_t>(options.samples));
  const gpu::Counters before = context_->counters();
  const std::uint64_t tessellatedBefore = geometry_.meshes.tessellated();
  Stopwatch watch;

  const Snapshot& snapshot = evenScale_.of(scene);
  const VisibleList visible = cull(snapshot, cullOptions(options, samples));
  addCounts(statistics.count, visible.counts);
  statistics.ms.cull += watch.lap();

  DrawOptions able = options;
  able.doubles = options.doubles && context_->features().float64;
  able.skips.hidden = options.skips.hidden && context_->deviceInfo().type == gpu::DeviceType::Cpu;
  able.samples = samples;
  const DrawList list = listDraws(snapshot, visible, able, geometry_, care);
  statistics.error = {.tolerancePx = options.tolerancePx, .boundPx = list.boundPx};
  statistics.count.culledHidden = list.culledHidden;
  statistics.count.tessellated += geometry_.meshes.tessellated() - tessellatedBefore;
  statistics.ms.tessellate += watch.lap();

  format_.samples = samples;
  prepareTargets({static_cast<std::uint32_t>(snapshot.view.size.width),
                  static_cast<std::uint32_t>(snapshot.view.size.height)},
                 samples);
  using enum gpu::Use;
  store_.dropUnused();
  Uploads& uploads = care.completes ? completion_ : uploads_;
  const float guard = guardOf(color_.extent(), context_->limits());
  upload(list, guarded(list.view, guard), !options.skips.unchanged, uploads);
  Bindings bindings{.scene = frames.descriptors().write(
                        pipelines_.sceneLayout(), {uploads.view.buffer,
                                                   uploads.instances.buffer,
                                                   {uploads.lights.buffer, 0, sizeof(shared::LightSet)}})};
  if (!list.patternParameters.empty())
    bindings.pattern =
        frames.descriptors().write(pipelines_.patternLayout(), {uploads.patternParameters.buffer});
  clearTally(list);
  if (list.exact()) {
    bindings.exact = frames.descriptors().write(
        pipelines_.exactLayout(),
        {uploads.exactInstances.buffer, uploads.exactPatches.buffer, uploads.exactParameters.buffer, tally_});
    bindings.hullIndices = uploads.hullIndices.buffer;
    gpu::use(commands, {{tally_, StorageWrite}});
  }

  const PassTargets targets{color_, resolved_ ? &resolved_ : nullptr, depth_};
  const auto pass = [&](const char* name, const std::vector<DrawBatch>& batches, VkAttachmentLoadOp load) {
    const gpu::Label label(*context_, commands, name);
    const auto contents = load == VK_ATTACHMENT_LOAD_OP_CLEAR ? gpu::Contents::Discard : gpu::Contents::Keep;
    gpu::use(commands, {{color_, ColorAttachment, contents}, {depth_, DepthAttachment, contents}});
    if (resolved_) gpu::use(commands, {{resolved_, ResolveTarget, gpu::Contents::Discard}});
    beginPass(commands, targets, load, backgroundOf(snapshot, options.output), guard);
    paint(commands, bindings, batches, statistics);
    vkCmdEndRendering(commands);
    ++statistics.count.passes;
  };
  pass("opaque", list.opaque, care.completes ? VK_ATTACHMENT_LOAD_OP_LOAD : VK_ATTACHMENT_LOAD_OP_CLEAR);
  if (!list.transparent.empty() || !options.skips.passes)
    pass("transparent", list.transparent, VK_ATTACHMENT_LOAD_OP_LOAD);
  if (list.exact()) gpu::use(commands, {{tally_, HostRead}});
  completable_ = list.transparent.empty();

  const gpu::Counters after = context_->counters();
  statistics.count.uploadBytes += after.uploadedBytes - before.uploadedBytes;
  statistics.count.pipelinesCreated += after.pipelinesCreated - before.pipelinesCreated;
  statistics.count.shadersCompiled += after.shadersCompiled - before.shadersCompiled;
  statistics.ms.upload += watch.lap();
}

void ScenePainter::prepareTargets(VkExtent2D extent, VkSampleCountFlagBits samples) {
  const bool fits = color_ && color_.extent().width == extent.width &&
                    color_.extent().height == extent.height && color_.samples() == samples;
  if (fits) return;
  constexpr VkImageUsageFlags kPicture =
      VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
  constexpr VkImageUsageFlags kDrawnOnly = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
  const bool multisampled = samples != VK_SAMPLE_COUNT_1_BIT;
  color_ = gpu::Texture(*context_, {.extent = extent,
                                    .format = format_.color,
                                    .usage = multisampled ? kDrawnOnly : kPicture,
                                    .samples = samples,
                                    .name = "color"});
  resolved_ =
      multisampled
          ? gpu::Texture(
                *context_,
                {.extent = extent, .format = format_.color, .usage = kPicture, .name = "color resolved"})
          : gpu::Texture();
  depth_ = gpu::Texture(*context_, {.extent = extent,
                                    .format = format_.depth,
                                    .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
                                    .samples = samples,
                                    .name = "depth"});
}

void ScenePainter::upload(const DrawList& list, const shared::ViewData& view, bool always, Uploads& uploads) {
  write(uploads.view, std::as_bytes(std::span(&view, 1)), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, "view", always);
  // A buffer has at least one element, so that there is something to bind.
  static const std::vector<shared::InstanceData> kNoInstance(1);
  const auto& instances = list.instances.empty() ? kNoInstance : list.instances;
  write(uploads.instances, std::as_bytes(std::span(instances)), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
        "instances", always);
  std::vector<std::byte> lights(lightStride_ * list.lightSets.size());
  for (std::size_t i = 0; i < list.lightSets.size(); ++i)
    std::memcpy(lights.data() + i * lightStride_, &list.lightSets[i], sizeof(shared::LightSet));
  write(uploads.lights, lights, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, "light sets", always);
  if (!list.patternParameters.empty())
    write(uploads.patternParameters, std::as_bytes(std::span(list.patternParameters)),
          VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "pattern parameters", always);
  if (!list.exact()) return;
  const auto store = [&](Mirror& mirror, const auto& elements, const char* name) {
    write(mirror, std::as_bytes(std::span(elements)), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, name, always);
  };
  if (!list.hullIndices.empty())
    write(uploads.hullIndices, std::as_bytes(std::span(list.hullIndices)), VK_BUFFER_USAGE_INDEX_BUFFER_BIT,
          "hull indices", always);
  store(uploads.exactInstances, list.exactInstances, "exact instances");
  store(uploads.exactPatches, list.exactPatches, "patches");
  store(uploads.exactParameters, inPairs(list.exactParameters), "parameters of formulas");
}

void ScenePainter::clearTally(const DrawList& list) {
  tallyNodes_.clear();
  if (!list.exact()) return;
  tallyNodes_ = list.instanceNodes;
  const VkDeviceSize bytes = (shared::kTallySlots + tallyNodes_.size()) * sizeof(std::uint32_t);
  if (!tally_ || tally_.size() < bytes) {
    tally_ = gpu::Buffer(*context_, {.size = 2 * bytes,
                                     .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                     .memory = gpu::MemoryUse::Readback,
                                     .name = "tally"});
  } else {
    context_->timeline().wait(context_->timeline().submitted());
  }
  std::ranges::fill(tally_.mapped(), std::byte{0});
  tally_.flush();
}

LostPixels ScenePainter::lostPixels() {
  if (tallyNodes_.empty()) return {};
  std::vector<std::uint32_t> counts(shared::kTallySlots + tallyNodes_.size());
  std::memcpy(counts.data(), tally_.read().data(), counts.size() * sizeof(std::uint32_t));
  const auto firstInstance = counts.begin() + shared::kTallySlots;
  LostPixels lost{.inFlat = {counts.begin(), firstInstance}, .inSteep = {}};
  for (std::size_t i = 0; i < tallyNodes_.size(); ++i)
    lost.inSteep[tallyNodes_[i]] += firstInstance[static_cast<std::ptrdiff_t>(i)];
  return lost;
}

void ScenePainter::write(Mirror& mirror, std::span<const std::byte> bytes, VkBufferUsageFlags usage,
                         const char* name, bool always) {
  if (!always && std::equal(bytes.begin(), bytes.end(), mirror.bytes.begin(), mirror.bytes.end())) return;
  if (!mirror.buffer || mirror.buffer.size() < bytes.size()) {
    mirror.buffer =
        gpu::Buffer(*context_, {.size = std::max<VkDeviceSize>(bytes.size(), 2 * mirror.bytes.size()),
                                .usage = usage,
                                .name = name});
  } else {
    // The frame before may still be reading; it is the only one that can be.
    context_->timeline().wait(context_->timeline().submitted());
  }
  mirror.buffer.write(0, bytes);
  mirror.bytes.assign(bytes.begin(), bytes.end());
}

void ScenePainter::paint(VkCommandBuffer commands, const Bindings& bindings,
                         const std::vector<DrawBatch>& batches, FrameStatistics& statistics) {
  for (const DrawBatch& batch : batches) {
    const gpu::GraphicsPipeline& pipeline = pipelines_.get(batch.state, format_);
    const bool withParameters = readsParameters(batch.state);
    const DeviceMesh& mesh = batch.hull ? store_.get(batch.hull) : store_.get(batch.mesh, withParameters);
    const auto lightOffset = static_cast<std::uint32_t>(batch.lightSet * lightStride_);

    pipeline.bind(commands);
    pipeline.bindSet(commands, 0, bindings.scene, {&lightOffset, 1});
    if (batch.state.pattern.valid()) pipeline.bindSet(commands, 1, bindings.pattern);
    if (batch.hull) {
      pipeline.bindSet(commands, 2, bindings.exact);
      const float side = batch.half == Half::Far ? -1.0f : 1.0f;
      pipeline.push(commands, std::as_bytes(std::span(&side, 1)));
    }
    gpu::setDepthBias(commands, biasOf(batch));
    vkCmdSetCullMode(commands, cullMode(batch.culling));
    vkCmdSetFrontFace(commands, batch.mirrored ? VK_FRONT_FACE_CLOCKWISE : VK_FRONT_FACE_COUNTER_CLOCKWISE);
    const VkBuffer streams[] = {mesh.vertices, withParameters ? mesh.parameters : mesh.vertices};
    constexpr VkDeviceSize kOffsets[] = {0, 0};
    vkCmdBindVertexBuffers(commands, 0, withParameters ? 2 : 1, streams, kOffsets);
    if (batch.hull)
      vkCmdBindIndexBuffer(commands, bindings.hullIndices, 0, VK_INDEX_TYPE_UINT32);
    else
      vkCmdBindIndexBuffer(commands, mesh.indices, 0, mesh.indexType);
    vkCmdDrawIndexed(commands, batch.indexCount, batch.instanceCount, batch.firstIndex, 0,
                     batch.firstInstance);

    ++statistics.count.drawCalls;
    statistics.count.instances += batch.instanceCount;
    statistics.count.triangles += batch.indexCount / 3 * batch.instanceCount;
    statistics.count.vertices += batch.vertexCount() * batch.instanceCount;
  }
}

}  // namespace luxo
