// SPDX-License-Identifier: Apache-2.0
#include "draw/scene_painter.h"

#include <limits>
#include <utility>
#include <vector>

#include "base/stopwatch.h"
#include "draw/light_sets.h"
#include "draw/pass_recorder.h"
#include "draw/shadow_list.h"
#include "gpu/barrier.h"

namespace luxo {
namespace {

CullOptions cullOptions(const DrawOptions& options) {
  return {.tolerancePx = options.tolerancePx,
          .samples = options.samples,
          .shading = options.shading,
          .ofGeometry = showsGeometry(options.output),
          .frustum = options.skips.frustum,
          .small = options.skips.small,
          .backface = options.skips.backface,
          .lights = options.skips.lights && options.shadows != ShadowKinds::None};
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

}  // namespace

ScenePainter::ScenePainter(gpu::Context& context)
    : context_(&context), pipelines_(context), store_(context), texels_(context) {}

DrawOptions ScenePainter::possible(const Snapshot& snapshot, const DrawOptions& options) const {
  DrawOptions able = options;
  able.doubles = options.doubles && context_->features().float64;
  able.skips.hidden = options.skips.hidden && context_->deviceInfo().type == gpu::DeviceType::Cpu;
  const auto wanted = static_cast<std::uint32_t>(options.samples);
  // Shadows and layers are found, and groups of lights added, for one point of each pixel.
  const bool one = options.output != Output::Color || findsShadows(snapshot, options) ||
                   hasLayers(snapshot, options) || occludesAmbient(snapshot, options) ||
                   tracesRays(snapshot, options) || hasManyLights(snapshot, options);
  able.samples = one ? 1 : static_cast<int>(context_->supportedSamples(wanted));
  return able;
}

void ScenePainter::check(const Snapshot& snapshot, const DrawOptions& options) {
  pipelines_.programs().check(snapshot, cull(snapshot, cullOptions(possible(snapshot, options))));
}

void ScenePainter::record(gpu::FrameRing& frames, VkCommandBuffer commands, RenderView& view,
                          const Snapshot& scene, const DrawOptions& wanted, FrameStatistics& statistics) {
  const gpu::Counters before = context_->counters();
  const DrawOptions options = possible(scene, wanted);
  const Snapshot& snapshot = scaleNormalization_.of(scene);
  DrawList list = listed(snapshot, options, statistics);
  Stopwatch watch;
  pipelines_.beginPicture();
  preparePipelines(list, view.targets().format(static_cast<VkSampleCountFlagBits>(options.samples)));
  store_.dropUnused();
  const VkExtent2D extent{static_cast<std::uint32_t>(snapshot.view.size.width),
                          static_cast<std::uint32_t>(snapshot.view.size.height)};
  const VkClearColorValue background = backgroundOf(snapshot, options.output);
  if (options.skips.unchanged && view.hasFound(snapshot, list, options, frames))
    view.relight(std::move(list), background);
  else
    view.begin(std::move(list), options, background, extent);
  recordPasses(frames, commands, view, {.relights = view.relit()}, statistics);
  if (options.skips.unchanged) view.recorded(snapshot, frames);

  context_->counted().shadersCompiled += pipelines_.programs().takeCompiled();
  const gpu::Counters after = context_->counters();
  statistics.count.uploadBytes += after.uploadedBytes - before.uploadedBytes;
  statistics.count.pipelinesCreated += after.pipelinesCreated - before.pipelinesCreated;
  statistics.count.shadersCompiled += after.shadersCompiled - before.shadersCompiled;
  statistics.ms.upload += watch.lap();
}

DrawList ScenePainter::listed(const Snapshot& snapshot, const DrawOptions& options,
                              FrameStatistics& statistics) {
  geometry_.shells.resume();
  const std::uint64_t tessellatedBefore = geometry_.tessellated();
  Stopwatch watch;
  const VisibleList visible = cull(snapshot, cullOptions(options));
  addCounts(statistics.count, visible.counts);
  statistics.ms.cull += watch.lap();
  pipelines_.programs().check(snapshot, visible);
  DrawList list = listDraws(snapshot, visible, options, geometry_);
  statistics.error = {.tolerancePx = options.tolerancePx, .boundPx = list.boundPx};
  statistics.count.culledHidden = list.culledHidden;
  statistics.count.culledTrianglesFrustum = list.clusters.culledFrustum;
  statistics.count.culledTrianglesBackface = list.clusters.culledBackface;
  statistics.count.tooLarge = list.tooLarge;
  statistics.count.deferred += list.deferred;
  statistics.count.tessellated += geometry_.tessellated() - tessellatedBefore;
  statistics.ms.tessellate += watch.lap();
  return list;
}

void ScenePainter::preparePipelines(const DrawList& list, const PictureFormat& format) {
  std::vector<ScenePipelines::Wanted> wanted;
  for (const Pass& pass : passesOf(list, {})) {
    const TargetFormat targets = formatOf(pass, format);
    for (DrawState& state : statesOf(pass)) wanted.push_back({std::move(state), targets});
  }
  pipelines_.prepare(wanted);
}

void ScenePainter::recordAnswers(gpu::FrameRing& frames, VkCommandBuffer commands, RenderView& view,
                                 const SecondaryRays& rays, const RayPoints& points,
                                 FrameStatistics& statistics) {
  view.traces().answer(rays.starts(), rays.answers());
  view.goOn(points);
  recordPasses(frames, commands, view, {.rays = &points}, statistics);
}

void ScenePainter::recordRays(gpu::FrameRing& frames, VkCommandBuffer commands, RenderView& view,
                              const RayPoints& points, FrameStatistics& statistics) {
  view.goOn(points);
  recordPasses(frames, commands, view, {.rays = &points}, statistics);
}

void ScenePainter::recordPasses(gpu::FrameRing& frames, VkCommandBuffer commands, RenderView& view,
                                const FrameDesc& desc, FrameStatistics& statistics) {
  FrameDesc frame = desc;
  frame.emptyPasses = !view.options().skips.passes;
  frame.probes = view.feedback().probes();
  frame.layerBands = view.layerLists().bands();
  const RenderView::Bindings bindings = view.bind(frames, pipelines_, texels_);
  if (view.list().traces) view.traces().clear(commands);
  if (view.list().runsShaders && !frame.rays) {
    gpu::use(commands, {{view.faults(), gpu::Use::TransferDestination}});
    vkCmdFillBuffer(commands, view.faults(), 0, VK_WHOLE_SIZE, 0);
  }
  if (frame.relights && view.list().layers.any()) view.layerLists().goOn(commands);
  PassRecorder recorder(*context_, pipelines_, store_, view, bindings, commands, statistics);
  for (const Pass& pass : passesOf(view.list(), frame)) {
    frames.mark(pass.name);
    recorder.record(pass);
  }
  frames.mark(gpu::FrameRing::kUnmarked);
  if (frame.probes) view.feedback().recordColorProbes(commands, view.picture());
  if (view.list().traces) gpu::use(commands, {{view.traces().questions(), gpu::Use::HostRead}});
  if (view.list().runsShaders) gpu::use(commands, {{view.faults(), gpu::Use::HostRead}});
  if (view.list().layers.any()) gpu::use(commands, {{view.layerLists().sums(), gpu::Use::HostRead}});
  if (view.list().findsPlaces) gpu::use(commands, {{view.feedback().shown(), gpu::Use::HostRead}});
  if (view.list().searches()) gpu::use(commands, {{view.feedback().doubtful(), gpu::Use::HostRead}});
}

}  // namespace luxo
