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

}  // namespace

ScenePainter::ScenePainter(gpu::Context& context, Precision precision)
    : context_(&context), pipelines_(context), store_(context) {
  format_.color =
      precision == Precision::Full ? VK_FORMAT_R32G32B32A32_SFLOAT : VK_FORMAT_R16G16B16A16_SFLOAT;
  const VkDeviceSize alignment = std::max<VkDeviceSize>(context.limits().minUniformBufferOffsetAlignment, 1);
  lightStride_ = (sizeof(shared::LightSet) + alignment - 1) / alignment * alignment;
}

void ScenePainter::record(gpu::FrameRing& frames, VkCommandBuffer commands, const Snapshot& scene,
                          const DrawOptions& options, FrameStatistics& statistics,
                          const SearchRefinement& refinement) {
  const bool auxiliary = options.output != Output::Color;
  const VkSampleCountFlagBits samples =
      auxiliary ? VK_SAMPLE_COUNT_1_BIT
                : context_->supportedSamples(static_cast<std::uint32_t>(options.samples));
  const gpu::Counters before = context_->counters();
  geometry_.shells.resume();
  const std::uint64_t tessellatedBefore = geometry_.tessellated();
  Stopwatch watch;

  const Snapshot& snapshot = scaleNormalization_.of(scene);
  const VisibleList visible = cull(snapshot, cullOptions(options, samples));
  addCounts(statistics.count, visible.counts);
  statistics.ms.cull += watch.lap();

  options_ = options;
  options_.doubles = options.doubles && context_->features().float64;
  options_.skips.hidden = options.skips.hidden && context_->deviceInfo().type == gpu::DeviceType::Cpu;
  options_.samples = samples;
  list_ = listDraws(snapshot, visible, options_, geometry_, refinement);
  const DrawList& list = list_;
  background_ = backgroundOf(snapshot, options.output);
  statistics.error = {.tolerancePx = options.tolerancePx, .boundPx = list.boundPx};
  statistics.count.culledHidden = list.culledHidden;
  statistics.count.tooLarge = list.tooLarge;
  statistics.count.tessellated += geometry_.tessellated() - tessellatedBefore;
  statistics.ms.tessellate += watch.lap();

  format_.samples = samples;
  prepareTargets({static_cast<std::uint32_t>(snapshot.view.size.width),
                  static_cast<std::uint32_t>(snapshot.view.size.height)},
                 samples);
  using enum gpu::Use;
  store_.dropUnused();
  if (!refinement.completes) pipelines_.beginPicture();
  preparePipelines();
  Uploads& uploads = refinement.completes ? completion_ : uploads_;
  upload(list, guarded(list.view, guardOf(color_.extent(), context_->limits())), !options.skips.unchanged,
         uploads);
  clearFeedback(list);
  clearDoubts(list.exact());
  chooseProbes();
  const Bindings bindings = bind(frames, uploads, uploads.instances.buffer);
  if (list.exact()) gpu::use(commands, {{feedback_, StorageWrite}, {doubts_, StorageWrite}});
  recordPasses(commands, bindings, refinement.completes, nullptr, statistics);
  if (list.exact()) gpu::use(commands, {{feedback_, HostRead}, {doubts_, HostRead}});
  completable_ = list.transparent.empty();

  const gpu::Counters after = context_->counters();
  statistics.count.uploadBytes += after.uploadedBytes - before.uploadedBytes;
  statistics.count.pipelinesCreated += after.pipelinesCreated - before.pipelinesCreated;
  statistics.count.shadersCompiled += after.shadersCompiled - before.shadersCompiled;
  statistics.ms.upload += watch.lap();
}

void ScenePainter::preparePipelines() {
  std::vector<DrawState> states;
  for (const auto* batches : {&list_.opaque, &list_.transparent})
    for (const DrawBatch& batch : *batches) states.push_back(batch.state);
  pipelines_.prepare(states, format_);
}

ScenePainter::Bindings ScenePainter::bind(gpu::FrameRing& frames, const Uploads& uploads,
                                          const gpu::Buffer& instances) {
  Bindings bindings{
      .scene = frames.descriptors().write(
          pipelines_.sceneLayout(),
          {uploads.view.buffer, instances, {uploads.lights.buffer, 0, sizeof(shared::LightSet)}})};
  if (!list_.patternParameters.empty())
    bindings.pattern =
        frames.descriptors().write(pipelines_.patternLayout(), {uploads.patternParameters.buffer});
  if (list_.exact()) {
    bindings.exact = frames.descriptors().write(pipelines_.exactLayout(),
                                                {uploads.exactInstances.buffer, uploads.exactPatches.buffer,
                                                 uploads.exactParameters.buffer, feedback_, doubts_});
    bindings.shellIndices = uploads.shellIndices.buffer;
  }
  return bindings;
}

void ScenePainter::recordPasses(VkCommandBuffer commands, const Bindings& bindings, bool completes,
                                const RayDraws* rays, FrameStatistics& statistics) {
  using enum gpu::Use;
  const float guard = guardOf(color_.extent(), context_->limits());
  const PassTargets targets{color_, resolved_ ? &resolved_ : nullptr, depth_};
  const auto pass = [&](const char* name, std::span<const DrawBatch> batches, VkAttachmentLoadOp load,
                        const RayDraws* points) {
    const gpu::Label label(*context_, commands, name);
    const auto contents = load == VK_ATTACHMENT_LOAD_OP_CLEAR ? gpu::Contents::Discard : gpu::Contents::Keep;
    gpu::use(commands, {{color_, ColorAttachment, contents}, {depth_, DepthAttachment, contents}});
    if (resolved_) gpu::use(commands, {{resolved_, ResolveTarget, gpu::Contents::Discard}});
    beginPass(commands, targets, load, background_, guard);
    paint(commands, bindings, batches, statistics);
    if (points) paintRays(commands, *points, statistics);
    vkCmdEndRendering(commands);
    ++statistics.count.passes;
  };
  const auto firstMesh =
      std::ranges::find_if(list_.opaque, [](const DrawBatch& batch) { return !batch.shell; });
  const std::span<const DrawBatch> found(list_.opaque.begin(), firstMesh),
      meshes(firstMesh, list_.opaque.end());
  const bool begins = !completes && !(rays && list_.onlyFound());
  if (rays && !begins)
    pass("rays", {}, VK_ATTACHMENT_LOAD_OP_LOAD, rays);
  else
    pass(meshes.empty() || !found.empty() ? "found" : "opaque", found.empty() ? meshes : found,
         begins ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD, rays);
  if (!probed_.empty()) recordProbes(commands);
  if (!begins && rays) return;
  if (!found.empty() && !meshes.empty()) pass("meshes", meshes, VK_ATTACHMENT_LOAD_OP_LOAD, nullptr);
  if (!list_.transparent.empty() || !options_.skips.passes)
    pass("transparent", list_.transparent, VK_ATTACHMENT_LOAD_OP_LOAD, nullptr);
}

void ScenePainter::recordRays(gpu::FrameRing& frames, VkCommandBuffer commands, const RayPoints& points,
                              FrameStatistics& statistics) {
  using enum gpu::Use;
  std::vector<shared::InstanceData> instances;
  for (const RayPoints::Run& run : points.runs) instances.push_back(list_.found[run.found].instance);
  if (instances.empty()) instances.resize(1);  // something to bind
  write(rayInstances_, std::as_bytes(std::span(instances)), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
        "instances of rays", false);
  if (!points.vertices.empty())
    write(rayVertices_, std::as_bytes(std::span(points.vertices)), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT,
          "points of rays", false);
  const Bindings ofRays = bind(frames, uploads_, rayInstances_.buffer);
  const RayDraws rays{.points = points, .pattern = ofRays.pattern, .scene = ofRays.scene};
  if (list_.exact()) gpu::use(commands, {{feedback_, StorageWrite}, {doubts_, StorageWrite}});
  recordPasses(commands, bind(frames, uploads_, uploads_.instances.buffer), false, &rays, statistics);
  if (list_.exact()) gpu::use(commands, {{feedback_, HostRead}, {doubts_, HostRead}});
}

void ScenePainter::paintRays(VkCommandBuffer commands, const RayDraws& rays, FrameStatistics& statistics) {
  std::vector<VkClearRect> empty;  // runs of pixels in a row
  for (const PixelPlace& pixel : rays.points.misses) {
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
  const VkClearAttachment cleared[] = {
      {.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .clearValue = {.color = background_}},
      {.aspectMask = VK_IMAGE_ASPECT_DEPTH_BIT, .clearValue = {.depthStencil = {0.0f, 0}}}};
  if (!empty.empty())
    vkCmdClearAttachments(commands, 2, cleared, static_cast<std::uint32_t>(empty.size()), empty.data());

  const VkExtent2D extent = color_.extent();
  const RayTarget target{Vec2f(extent.width, extent.height), guardOf(extent, context_->limits())};
  std::uint32_t instance = 0;
  for (const RayPoints::Run& run : rays.points.runs) {
    const FoundNode& node = list_.found[run.found];
    const gpu::GraphicsPipeline& pipeline = pipelines_.get(node.state, format_);
    const auto lightOffset = static_cast<std::uint32_t>(node.lightSet * lightStride_);
    pipeline.bind(commands);
    pipeline.bindSet(commands, 0, rays.scene, {&lightOffset, 1});
    if (node.state.pattern.valid()) pipeline.bindSet(commands, 1, rays.pattern);
    pipeline.push(commands, std::as_bytes(std::span(&target, 1)));
    gpu::setDepthBias(commands, {});
    vkCmdSetCullMode(commands, VK_CULL_MODE_NONE);
    vkCmdSetFrontFace(commands, VK_FRONT_FACE_COUNTER_CLOCKWISE);
    const VkBuffer stream = rayVertices_.buffer;
    constexpr VkDeviceSize kOffset = 0;
    vkCmdBindVertexBuffers(commands, 0, 1, &stream, &kOffset);
    vkCmdDraw(commands, run.vertexCount, 1, run.firstVertex, instance++);
    ++statistics.count.drawCalls;
    ++statistics.count.instances;
    statistics.count.triangles += run.vertexCount / 3;
    statistics.count.vertices += run.vertexCount;
  }
}

void ScenePainter::chooseProbes() {
  probed_.clear();
  if (list_.found.empty() || color_.samples() != VK_SAMPLE_COUNT_1_BIT) return;
  const VkExtent2D extent = color_.extent();
  probed_ = auditedPixels({static_cast<int>(extent.width), static_cast<int>(extent.height)}, options_.audit,
                          list_.outlines);
  // A region for each of many pixels takes longer than all pixels at once.
  constexpr std::size_t kMaxRegions = 4096;
  probesAll_ = probed_.size() > kMaxRegions;
  const VkDeviceSize bytes = sizeof(float) * (probesAll_ ? VkDeviceSize{extent.width} * extent.height
                                                         : VkDeviceSize{probed_.size()});
  if (bytes > 0 && (!probes_ || probes_.size() < bytes))
    probes_ = gpu::Buffer(*context_, {.size = bytes, .memory = gpu::MemoryUse::Readback, .name = "probes"});
}

void ScenePainter::recordProbes(VkCommandBuffer commands) {
  const VkExtent2D extent = depth_.extent();
  std::vector<VkBufferImageCopy> regions;
  const VkImageSubresourceLayers depth{.aspectMask = VK_IMAGE_ASPECT_DEPTH_BIT, .layerCount = 1};
  if (probesAll_)
    regions.push_back({.imageSubresource = depth, .imageExtent = {extent.width, extent.height, 1}});
  else
    for (std::size_t i = 0; i < probed_.size(); ++i)
      regions.push_back({.bufferOffset = sizeof(float) * i,
                         .imageSubresource = depth,
                         .imageOffset = {probed_[i].x, probed_[i].y, 0},
                         .imageExtent = {1, 1, 1}});
  gpu::use(commands, {{depth_, gpu::Use::TransferSource}, {probes_, gpu::Use::TransferDestination}});
  vkCmdCopyImageToBuffer(commands, depth_, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, probes_,
                         static_cast<std::uint32_t>(regions.size()), regions.data());
  gpu::use(commands, {{probes_, gpu::Use::HostRead}});
}

std::vector<DepthProbe> ScenePainter::probes() {
  std::vector<DepthProbe> probes;
  if (probed_.empty()) return probes;
  const std::span<const std::byte> depths = probes_.read();
  for (std::size_t i = 0; i < probed_.size(); ++i) {
    const auto [x, y] = probed_[i];
    const std::size_t place =
        probesAll_ ? static_cast<std::size_t>(y) * depth_.extent().width + static_cast<std::size_t>(x) : i;
    DepthProbe probe{.pixel = probed_[i]};
    std::memcpy(&probe.depth, depths.data() + sizeof(float) * place, sizeof(float));
    probes.push_back(probe);
  }
  return probes;
}

void ScenePainter::clearDoubts(bool searches) {
  if (!searches) return;
  const VkExtent2D extent = color_.extent();
  const VkDeviceSize pixels = VkDeviceSize{extent.width} * extent.height;
  const VkDeviceSize bytes =
      (pixels + shared::kDoubtsPerWord - 1) / shared::kDoubtsPerWord * sizeof(std::uint32_t);
  if (!doubts_ || doubts_.size() != bytes)
    doubts_ = gpu::Buffer(*context_, {.size = bytes,
                                      .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                      .memory = gpu::MemoryUse::Readback,
                                      .name = "doubts"});
  else
    context_->timeline().wait(context_->timeline().submitted());
  std::ranges::fill(doubts_.mapped(), std::byte{0});
  doubts_.flush();
}

std::vector<ScenePainter::Doubt> ScenePainter::doubts() {
  const auto width = static_cast<std::int32_t>(color_.extent().width),
             height = static_cast<std::int32_t>(color_.extent().height);
  const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  std::vector<std::uint32_t> words((pixels + shared::kDoubtsPerWord - 1) / shared::kDoubtsPerWord);
  if (list_.exact()) std::memcpy(words.data(), doubts_.read().data(), words.size() * sizeof(std::uint32_t));
  for (const PixelRect& rect : list_.byRays)
    for (std::int32_t y = rect.low.y; y < rect.high.y; ++y)
      for (std::int32_t x = rect.low.x; x < rect.high.x; ++x) {
        const std::size_t pixel =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
        words[pixel / shared::kDoubtsPerWord] |= shared::kLostHere
                                                 << shared::kDoubtBits * (pixel % shared::kDoubtsPerWord);
      }
  std::vector<Doubt> doubts;
  for (std::size_t word = 0; word < words.size(); ++word)
    for (std::uint32_t bits = words[word], k = 0; bits != 0; bits >>= shared::kDoubtBits, ++k) {
      if ((bits & (shared::kLostHere | shared::kUncertifiedHere)) == 0) continue;
      const auto pixel = static_cast<std::int32_t>(word * shared::kDoubtsPerWord + k);
      doubts.push_back({{pixel % width, pixel / width}, (bits & shared::kLostHere) != 0});
    }
  return doubts;
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
  depth_ = gpu::Texture(
      *context_, {.extent = extent,
                  .format = format_.depth,
                  .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
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
  if (!list.shellIndices.empty())
    write(uploads.shellIndices, std::as_bytes(std::span(list.shellIndices)), VK_BUFFER_USAGE_INDEX_BUFFER_BIT,
          "shell indices", always);
  store(uploads.exactInstances, list.exactInstances, "exact instances");
  store(uploads.exactPatches, list.exactPatches, "patches");
  store(uploads.exactParameters, inPairs(list.exactParameters), "parameters of formulas");
}

void ScenePainter::clearFeedback(const DrawList& list) {
  feedbackNodes_.clear();
  if (!list.exact()) return;
  feedbackNodes_ = list.instanceNodes;
  const VkDeviceSize bytes = (shared::kFeedbackSlots + feedbackNodes_.size()) * sizeof(std::uint32_t);
  if (!feedback_ || feedback_.size() < bytes) {
    feedback_ = gpu::Buffer(*context_, {.size = 2 * bytes,
                                        .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                        .memory = gpu::MemoryUse::Readback,
                                        .name = "feedback"});
  } else {
    context_->timeline().wait(context_->timeline().submitted());
  }
  std::ranges::fill(feedback_.mapped(), std::byte{0});
  feedback_.flush();
}

LostPixels ScenePainter::lostPixels() {
  if (feedbackNodes_.empty()) return {};
  std::vector<std::uint32_t> counts(shared::kFeedbackSlots + feedbackNodes_.size());
  std::memcpy(counts.data(), feedback_.read().data(), counts.size() * sizeof(std::uint32_t));
  const auto firstInstance = counts.begin() + shared::kFeedbackSlots;
  LostPixels lost{.transversal = {counts.begin(), firstInstance}, .grazing = {}};
  for (std::size_t i = 0; i < feedbackNodes_.size(); ++i)
    lost.grazing[feedbackNodes_[i]] += firstInstance[static_cast<std::ptrdiff_t>(i)];
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
                         std::span<const DrawBatch> batches, FrameStatistics& statistics) {
  for (const DrawBatch& batch : batches) {
    const gpu::GraphicsPipeline& pipeline = pipelines_.get(batch.state, format_);
    const bool withParameters = readsParameters(batch.state);
    const DeviceMesh& mesh = batch.shell ? store_.get(batch.shell) : store_.get(batch.mesh, withParameters);
    const auto lightOffset = static_cast<std::uint32_t>(batch.lightSet * lightStride_);

    pipeline.bind(commands);
    pipeline.bindSet(commands, 0, bindings.scene, {&lightOffset, 1});
    if (batch.state.pattern.valid()) pipeline.bindSet(commands, 1, bindings.pattern);
    if (batch.shell) {
      pipeline.bindSet(commands, 2, bindings.exact);
      const ShellDraw draw{batch.half == Half::Far ? -1.0f : 1.0f,
                           guardOf(color_.extent(), context_->limits())};
      pipeline.push(commands, std::as_bytes(std::span(&draw, 1)));
    }
    gpu::setDepthBias(commands, biasOf(batch));
    vkCmdSetCullMode(commands, cullMode(batch.culling));
    vkCmdSetFrontFace(commands, batch.mirrored ? VK_FRONT_FACE_CLOCKWISE : VK_FRONT_FACE_COUNTER_CLOCKWISE);
    const VkBuffer streams[] = {mesh.vertices, withParameters ? mesh.parameters : mesh.vertices};
    constexpr VkDeviceSize kOffsets[] = {0, 0};
    vkCmdBindVertexBuffers(commands, 0, withParameters ? 2 : 1, streams, kOffsets);
    if (batch.shell)
      vkCmdBindIndexBuffer(commands, bindings.shellIndices, 0, VK_INDEX_TYPE_UINT32);
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
