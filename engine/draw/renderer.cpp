// SPDX-License-Identifier: Apache-2.0
#include "draw/renderer.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <span>
#include <utility>

#include "base/assert.h"
#include "base/stopwatch.h"
#include "draw/light_sets.h"
#include "draw/measured_pixels.h"
#include "draw/shadow_list.h"
#include "tessellate/parallel.h"

namespace luxo {
namespace {

int channelsOf(Output output) {
  return output == Output::Depth || output == Output::Id || output == Output::Residual ||
                 output == Output::Certificate
             ? 1
             : 3;
}

constexpr int kBandRows = 32;                         // of a picture that is read on all cores,
constexpr std::int64_t kPixelsForAllCores = 1 << 16;  // as is worth from 0.1 ms

template <int kChannels>
void readChannels(const std::byte* texels, int width, float* out) {
  for (int x = 0; x < width; ++x)
    std::memcpy(out + kChannels * x, texels + sizeof(Vec4f) * x, kChannels * sizeof(float));
}

/// World positions are completed in double: far from the world's origin a float cannot hold both that
/// of the shaders and the rest.
void readPositions(const std::byte* texels, int width, const Vec3& origin, float* out) {
  for (int x = 0; x < width; ++x, out += 3) {
    Vec4f value;
    std::memcpy(&value, texels + sizeof value * x, sizeof value);
    const Vec3f position = value.w != 0 ? Vec3f(Vec3(value) + origin) : Vec3f(value);
    std::memcpy(out, &position, sizeof position);
  }
}

/// The rows that pixels are in, which are sorted by row.
std::vector<gpu::Readback::Rows> rowsOf(std::span<const PixelPlace> pixels) {
  std::vector<gpu::Readback::Rows> rows;
  for (const PixelPlace& pixel : pixels) {
    const auto y = static_cast<std::uint32_t>(pixel.y);
    if (rows.empty() || rows.back().first + rows.back().count < y)
      rows.push_back({y, 1});
    else
      rows.back().count = y + 1 - rows.back().first;
  }
  return rows;
}

}  // namespace

DrawOptions drawOptions(const RenderSettings& settings) {
  return {.shading = settings.shading,
          .tolerancePx = settings.tolerance,
          .samples = settings.samples,
          .hiddenLines = settings.hiddenLines};
}

Renderer::Renderer()
    : owned_(std::make_unique<gpu::Context>()),
      context_(owned_.get()),
      frames_(*context_),
      painter_(*context_),
      view_(*context_, Precision::Full) {}

Renderer::Renderer(gpu::Context& context)
    : context_(&context), frames_(context), painter_(context), view_(context, Precision::Full) {}

Snapshot Renderer::snapshotOf(const Scene& scene) {
  const RenderSettings& settings = scene.settings();
  const bool hasCloth = scene.hasCloth(), movesVertices = scene.movesVertices();
  if (!hasCloth && !movesVertices) return takeSnapshot(scene, settings.time, settings.size);
  if (hasCloth && !cloth_) cloth_ = std::make_shared<DeviceClothSimulation>(*context_);
  if (movesVertices && !vertices_) vertices_ = std::make_shared<DeviceVertexMovement>(*context_);
  Scene moved = scene;
  if (hasCloth) moved.set(cloth_);
  if (movesVertices) moved.set(vertices_);
  return takeSnapshot(moved, settings.time, settings.size);
}

Picture Renderer::render(const Scene& scene) {
  const RenderSettings& settings = scene.settings();
  const Stopwatch watch;
  const Snapshot snapshot = snapshotOf(scene);
  const double animate = watch.milliseconds();
  Picture picture = render(snapshot, drawOptions(settings));
  picture.statistics.ms.animate = animate;
  picture.statistics.ms.total += animate;
  return picture;
}

Picture Renderer::render(const Snapshot& snapshot, const DrawOptions& options) {
  return *render(snapshot, options, [](double) { return true; });
}

std::optional<Picture> Renderer::render(const Snapshot& snapshot, const DrawOptions& options,
                                        const std::function<bool(double)>& goesOn) {
  LUXO_REQUIRE_COMPARE(options.samples, >=, 1);
  LUXO_REQUIRE_COMPARE(options.samples, <=, kMaxSamples);
  const Stopwatch watch;
  Picture picture;
  FrameStatistics& statistics = picture.statistics;
  if (options.skips.unchanged && shown_ && shown_->snapshot == snapshot && shown_->options == options) {
    if (!goesOn(0)) return std::nullopt;
    statistics = shownAgain(shown_->statistics);
    const Stopwatch reading;
    FrameError measured;  // as it was
    picture.image = readPicture(snapshot, options, measured);
    statistics.ms.readback = statistics.ms.total = reading.milliseconds();
    return picture;
  }
  shown_.reset();
  if (inOnePass(snapshot, options)) {
    if (!goesOn(0)) return std::nullopt;
    draw(snapshot, options, statistics);
  } else {
    if (!accumulator_) accumulator_.emplace(*context_);
    const std::vector<Vec2> offsets = samplePattern(options.samples);
    DrawOptions one = options;
    one.samples = 1;
    Snapshot sampled = snapshot;
    for (int k = 0; k < options.samples; ++k) {
      if (!goesOn(static_cast<double>(k) / options.samples)) return std::nullopt;
      sampled.view = sampledAt(snapshot.view, offsets[static_cast<std::size_t>(k)]);
      FrameStatistics pass;
      draw(sampled, one, pass);
      accumulate(k, k + 1 == options.samples, pass);
      addPass(statistics, pass);
    }
  }
  const Stopwatch reading;
  picture.image = readPicture(snapshot, options, statistics.error);
  statistics.ms.readback = reading.milliseconds();
  statistics.ms.total = watch.milliseconds();
  shown_ = {snapshot, options, statistics};
  return picture;
}

bool Renderer::inOnePass(const Snapshot& snapshot, const DrawOptions& options) const {
  const bool found = std::ranges::any_of(
      snapshot.nodes, [&](const SnapshotNode& node) { return findsSurface(snapshot, node, options); });
  const bool auxiliary = options.output != Output::Color;
  const bool native =
      options.samples == 1 || (options.samples == 4 && !found && !findsShadows(snapshot, options) &&
                               !hasLayers(snapshot, options) && !occludesAmbient(snapshot, options) &&
                               !tracesRays(snapshot, options) && !hasManyLights(snapshot, options));
  return auxiliary || (native && context_->supportedSamples(static_cast<std::uint32_t>(options.samples)) ==
                                     static_cast<VkSampleCountFlagBits>(options.samples));
}

void Renderer::draw(const Snapshot& snapshot, const DrawOptions& options, FrameStatistics& statistics) {
  const auto submitAndRead = [this](const Recording& record, const Refinement::Changed& changed,
                                    FrameStatistics& cost) {
    submit(
        [&](VkCommandBuffer commands) {
          record(commands);
          if (!changed)
            recordReadback(commands, view_.picture());
          else if (!changed->empty())
            readback_.record(commands, view_.picture(), rowsOf(*changed));
        },
        cost);
  };
  refinement_.begin(snapshot, options);
  while (const std::optional<Refinement::Rays> rays = refinement_.advance(submitAndRead)) (*rays)();
  statistics = refinement_.statistics();
}

void Renderer::submit(const Recording& record, FrameStatistics& statistics) {
  const VkCommandBuffer commands = frames_.begin();
  record(commands);
  const Stopwatch submitted;
  const std::uint64_t submission = frames_.submit();
  frames_.wait(submission);
  ++statistics.count.submits;
  statistics.ms.gpu += frames_.milliseconds(submission).value_or(submitted.milliseconds());
  addPassTimes(statistics.ms.passes, frames_.parts(submission));
}

void Renderer::accumulate(int before, bool complete, FrameStatistics& statistics) {
  submit(
      [&](VkCommandBuffer commands) {
        accumulator_->add(frames_, commands, view_.picture(), before);
        if (complete) recordReadback(commands, accumulator_->mean());
      },
      statistics);
}

void Renderer::recordReadback(VkCommandBuffer commands, gpu::Texture& picture) {
  const VkExtent2D extent = picture.extent();
  if (extent.width != readbackExtent_.width || extent.height != readbackExtent_.height) {
    readback_ = gpu::Readback(*context_, extent, picture.format());
    readbackExtent_ = extent;
  }
  readback_.record(commands, picture);
}

Image Renderer::readPicture(const Snapshot& snapshot, const DrawOptions& options, FrameError& error) {
  const Output output = options.output;
  const bool averaged = !inOnePass(snapshot, options);
  const int width = snapshot.view.size.width, height = snapshot.view.size.height,
            channels = channelsOf(output);
  // The colours of surfaces that were searched for carry their residual (shaders/lib/exact_fragment.glsl).
  const bool certifies = output == Output::Color && view_.searches();
  Image image(width, height, channels);
  const auto readRow = [&](int y, MeasuredPixels& measured) {
    const std::byte* texels = readback_.row(static_cast<std::uint32_t>(y)).data();
    if (certifies && averaged)
      addMeanAlphas(texels, width, measured);
    else if (certifies)
      addAlphas(texels, width, measured);
    const std::uint32_t before = measured.nonfinite;
    if (output == Output::Color) addColors(texels, width, measured);
    if (output == Output::Position)
      readPositions(texels, width, view_.list().origin, image.row(y).data());
    else if (channels == 3)
      readChannels<3>(texels, width, image.row(y).data());
    else
      readChannels<1>(texels, width, image.row(y).data());
    if (measured.nonfinite > before) showInMagenta(image.row(y));
  };
  std::vector<MeasuredPixels> bands(static_cast<std::size_t>((height + kBandRows - 1) / kBandRows));
  forEachIndex(bands.size(), static_cast<std::int64_t>(width) * height >= kPixelsForAllCores,
               [&](std::size_t band) {
                 const int first = static_cast<int>(band) * kBandRows;
                 for (int y = first; y < std::min(first + kBandRows, height); ++y) readRow(y, bands[band]);
               });
  MeasuredPixels measured;
  for (const MeasuredPixels& band : bands) measured.add(band);
  refuseShaders(snapshot, measured.faults);
  error.found = view_.searches();
  error.shadowed = view_.list().findsShadows();
  if (certifies) error.residualMaxPx = std::bit_cast<float>(measured.residual);
  error.nonfinitePx = measured.nonfinite;
  return image;
}

}  // namespace luxo
