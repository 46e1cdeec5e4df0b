// SPDX-License-Identifier: Apache-2.0
#include "draw/renderer.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstring>

#include "base/assert.h"

namespace luxo {
namespace {

double millisecondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// A picture that was drawn again took the time and the work of all attempts; it shows what the last one
/// drew, or completed.
void addAttempt(FrameStatistics& last, const FrameStatistics& before, bool completes) {
  for (const auto time : {&FrameTimes::tessellate, &FrameTimes::cull, &FrameTimes::upload, &FrameTimes::gpu})
    last.ms.*time += before.ms.*time;
  for (const auto count :
       {&FrameCounts::submits, &FrameCounts::uploadBytes, &FrameCounts::tessellated,
        &FrameCounts::pipelinesCreated, &FrameCounts::shadersCompiled, &FrameCounts::passes})
    last.count.*count += before.count.*count;
  if (completes)
    for (const auto count : {&FrameCounts::drawCalls, &FrameCounts::instances, &FrameCounts::triangles,
                             &FrameCounts::vertices, &FrameCounts::culledHidden})
      last.count.*count += before.count.*count;
}

int channelsOf(Output output) {
  return output == Output::Depth || output == Output::Id || output == Output::Residual ? 1 : 3;
}

template <int kChannels>
void readChannels(const std::byte* texels, int width, float* out) {
  for (int x = 0; x < width; ++x)
    std::memcpy(out + kChannels * x, texels + sizeof(Vec4f) * x, kChannels * sizeof(float));
}

/// World positions are completed in double: far from the origin a float cannot hold both the eye and the
/// rest.
void readPositions(const std::byte* texels, int width, const Vec3& eye, float* out) {
  for (int x = 0; x < width; ++x, out += 3) {
    Vec4f value;
    std::memcpy(&value, texels + sizeof value * x, sizeof value);
    const Vec3f position = value.w != 0 ? Vec3f(Vec3(value) + eye) : Vec3f(value);
    std::memcpy(out, &position, sizeof position);
  }
}

/// What the alphas of pixels tell of searches: the largest residual, as the bits of a float, whose order is
/// that of the floats, so that a compiler may take many at once; and how many are not certified.
struct Certificate {
  std::int32_t residual = 0;
  std::uint32_t uncertified = 0;

  void add(float alpha) {
    const auto bits = std::bit_cast<std::uint32_t>(alpha);
    residual = std::max(residual, static_cast<std::int32_t>(bits & 0x7fffffffU));
    uncertified += bits >> 31U;
  }
};

float alphaAt(const std::byte* texels, int x) {
  float alpha;
  std::memcpy(&alpha, texels + sizeof(Vec4f) * x + 3 * sizeof alpha, sizeof alpha);
  return alpha;
}

void addAlphas(const std::byte* texels, int width, Certificate& certificate) {
  Certificate row = certificate;
  for (int x = 0; x < width; ++x) row.add(alphaAt(texels, x));
  certificate = row;
}

void addMeanAlphas(const std::byte* texels, int width, Certificate& certificate) {
  for (int x = 0; x < width; ++x) certificate.add(Accumulator::alphaOf(alphaAt(texels, x)));
}

/// Of a frame that shows what the one before it showed: everything that was done for that one is not done.
FrameStatistics again(const FrameStatistics& before) {
  FrameStatistics now{.error = before.error};
  const FrameCounts& c = before.count;
  now.count = {.nodes = c.nodes,
               .drawn = c.drawn,
               .culledFrustum = c.culledFrustum,
               .culledSmall = c.culledSmall,
               .culledBackface = c.culledBackface,
               .culledLights = c.culledLights,
               .culledHidden = c.culledHidden};
  return now;
}

}  // namespace

DrawOptions drawOptions(const RenderSettings& settings) {
  return {.shading = settings.shading, .tolerancePx = settings.tolerance, .samples = settings.samples};
}

Renderer::Renderer()
    : owned_(std::make_unique<gpu::Context>()),
      context_(owned_.get()),
      frames_(*context_),
      painter_(*context_, Precision::Full) {}

Renderer::Renderer(gpu::Context& context)
    : context_(&context), frames_(context), painter_(context, Precision::Full) {}

Picture Renderer::render(const Scene& scene) {
  const RenderSettings& settings = scene.settings();
  const auto start = std::chrono::steady_clock::now();
  const Snapshot snapshot = takeSnapshot(scene, settings.time, settings.size);
  const double animate = millisecondsSince(start);
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
  LUXO_REQUIRE_COMPARE(options.samples, <=, kMostSamples);
  const auto start = std::chrono::steady_clock::now();
  Picture picture;
  FrameStatistics& statistics = picture.statistics;
  if (options.skips.unchanged && shown_ && shown_->snapshot == snapshot && shown_->options == options) {
    if (!goesOn(0)) return std::nullopt;
    statistics = again(shown_->statistics);
    const auto reading = std::chrono::steady_clock::now();
    FrameError measured;  // as it was
    picture.image = readPicture(snapshot, options, measured);
    statistics.ms.readback = statistics.ms.total = millisecondsSince(reading);
    return picture;
  }
  shown_.reset();
  if (inOnePass(options)) {
    if (!goesOn(0)) return std::nullopt;
    draw(snapshot, options, statistics,
         [&](VkCommandBuffer commands) { recordReadback(commands, painter_.target()); });
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
      draw(sampled, one, pass, [](VkCommandBuffer) {});
      accumulate(k, k + 1 == options.samples, pass);
      addPass(statistics, pass);
    }
  }
  const auto reading = std::chrono::steady_clock::now();
  picture.image = readPicture(snapshot, options, statistics.error);
  statistics.ms.readback = millisecondsSince(reading);
  statistics.ms.total = millisecondsSince(start);
  shown_ = {snapshot, options, statistics};
  return picture;
}

bool Renderer::inOnePass(const DrawOptions& options) const {
  const bool auxiliary = options.output != Output::Color;
  const bool native = options.samples == 1 || options.samples == 4;
  return auxiliary || (native && context_->supportedSamples(static_cast<std::uint32_t>(options.samples)) ==
                                     static_cast<VkSampleCountFlagBits>(options.samples));
}

void Renderer::draw(const Snapshot& snapshot, const DrawOptions& options, FrameStatistics& statistics,
                    const Recording& then) {
  SearchCare care;
  for (bool again = false;; again = true) {
    FrameStatistics attempt;
    const VkCommandBuffer commands = frames_.begin();
    painter_.record(frames_, commands, snapshot, options, attempt, care);
    then(commands);
    const auto submitted = std::chrono::steady_clock::now();
    const std::uint64_t submission = frames_.submit();
    frames_.wait(submission);
    attempt.count.submits = 1;
    attempt.ms.gpu = frames_.milliseconds(submission).value_or(millisecondsSince(submitted));
    if (again) addAttempt(attempt, statistics, care.completes);
    statistics = attempt;

    const bool mayFindMore = care.learn(painter_.lostPixels());
    statistics.error.unconvergedPx = care.lost();
    if (!mayFindMore) return;
    care.completes = painter_.completable();
  }
}

void Renderer::accumulate(int before, bool complete, FrameStatistics& statistics) {
  const VkCommandBuffer commands = frames_.begin();
  accumulator_->add(frames_, commands, painter_.target(), before);
  if (complete) recordReadback(commands, accumulator_->mean());
  const auto submitted = std::chrono::steady_clock::now();
  const std::uint64_t submission = frames_.submit();
  frames_.wait(submission);
  ++statistics.count.submits;
  statistics.ms.gpu += frames_.milliseconds(submission).value_or(millisecondsSince(submitted));
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
  const bool averaged = !inOnePass(options);
  const int width = snapshot.view.size.width, height = snapshot.view.size.height,
            channels = channelsOf(output);
  // The colours of surfaces that were searched for carry their residual (shaders/lib/exact_fragment.glsl).
  // A view of the residuals has them as its colour.
  const bool certifies =
      output == Output::Color && options.shading != Shading::Residual && painter_.searches();
  Certificate certificate;
  Image image(width, height, channels);
  for (int y = 0; y < height; ++y) {
    const std::byte* texels = readback_.row(static_cast<std::uint32_t>(y)).data();
    if (certifies && averaged)
      addMeanAlphas(texels, width, certificate);
    else if (certifies)
      addAlphas(texels, width, certificate);
    if (output == Output::Position)
      readPositions(texels, width, snapshot.view.eye, image.row(y).data());
    else if (channels == 3)
      readChannels<3>(texels, width, image.row(y).data());
    else
      readChannels<1>(texels, width, image.row(y).data());
  }
  if (certifies) {
    error.residualMaxPx = std::bit_cast<float>(certificate.residual);
    error.uncertifiedPx += certificate.uncertified;
  }
  return image;
}

}  // namespace luxo
