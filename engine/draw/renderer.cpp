// SPDX-License-Identifier: Apache-2.0
#include "draw/renderer.h"

#include <chrono>
#include <cstring>

#include "gpu/barrier.h"

namespace luxo {
namespace {

double millisecondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

int channelsOf(Output output) {
  return output == Output::Depth || output == Output::Id || output == Output::Residual ? 1 : 3;
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
  const auto start = std::chrono::steady_clock::now();
  Picture picture;
  FrameStatistics& statistics = picture.statistics;

  const VkCommandBuffer commands = frames_.begin();
  painter_.record(frames_, commands, snapshot, options, statistics);
  gpu::Texture& target = painter_.target();
  const VkExtent2D extent = target.extent();
  if (extent.width != readbackExtent_.width || extent.height != readbackExtent_.height) {
    readback_ = gpu::Readback(*context_, extent, target.format());
    readbackExtent_ = extent;
  }
  readback_.record(commands, target);
  const auto submitted = std::chrono::steady_clock::now();
  const std::uint64_t submission = frames_.submit();
  frames_.wait(submission);
  statistics.count.submits = 1;
  statistics.ms.gpu = frames_.milliseconds(submission).value_or(millisecondsSince(submitted));

  const auto reading = std::chrono::steady_clock::now();
  picture.image = readPicture(snapshot, options.output);
  statistics.ms.readback = millisecondsSince(reading);
  statistics.ms.total = millisecondsSince(start);
  return picture;
}

Image Renderer::readPicture(const Snapshot& snapshot, Output output) {
  const int width = snapshot.view.size.width, height = snapshot.view.size.height,
            channels = channelsOf(output);
  Image image(width, height, channels);
  for (int y = 0; y < height; ++y) {
    const std::byte* texel = readback_.row(static_cast<std::uint32_t>(y)).data();
    float* out = image.row(y).data();
    for (int x = 0; x < width; ++x, texel += sizeof(Vec4f), out += channels) {
      Vec4f value;
      std::memcpy(&value, texel, sizeof value);
      // World positions are completed in double: far from the origin a float cannot hold both the eye and the
      // rest.
      if (output == Output::Position && value.w != 0)
        value = Vec4f(Vec3f(Vec3(value) + snapshot.view.eye), 1);
      std::memcpy(out, &value, channels * sizeof(float));
    }
  }
  return image;
}

}  // namespace luxo
