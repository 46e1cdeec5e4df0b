// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks.h"
#include "gpu/frame.h"
#include "gpu/transfer.h"
#include "image/compare.h"
#include "luxo_frames.h"
#include "process_tuning.h"
#include "scene/snapshot.h"
#include "side_by_side.h"
#include "straightforward.h"

namespace luxo::bench {
namespace {

constexpr PixelSize kSizes[] = {{1280, 720}, {1920, 1080}};
constexpr double kStill = 21, kPeriod = 8 * kPi;

std::vector<double> overThePeriod() {
  std::vector<double> times;
  for (int i = 0; i < 16; ++i) times.push_back(kPeriod * i / 16);
  return times;
}

/// The straightforward path's frames, with the same beginning and end.
class StraightforwardFrames {
 public:
  StraightforwardFrames(gpu::Context& context, const FrameDesc& desc)
      : size_(desc.size),
        frames_(context),
        path_(context, desc.size,
              desc.precision == Precision::Full ? VK_FORMAT_R32G32B32A32_SFLOAT
                                                : VK_FORMAT_R16G16B16A16_SFLOAT),
        readback_(context, path_.target().extent(), path_.target().format()) {}

  void draw(double time) {
    path_.record(frames_, frames_.begin(), static_cast<float>(time));
    frames_.wait(frames_.submit());
  }

  /// Full precision only.
  Image picture(double time) {
    const VkCommandBuffer commands = frames_.begin();
    path_.record(frames_, commands, static_cast<float>(time));
    readback_.record(commands, path_.target());
    frames_.wait(frames_.submit());
    Image image(size_.width, size_.height, 3);
    for (int y = 0; y < size_.height; ++y) {
      const std::byte* texel = readback_.row(static_cast<std::uint32_t>(y)).data();
      for (int x = 0; x < size_.width; ++x, texel += sizeof(Vec4f))
        std::memcpy(image.pixel(x, y).data(), texel, sizeof(Vec3f));
    }
    return image;
  }

  [[nodiscard]] const Straightforward& path() const { return path_; }

 private:
  PixelSize size_;
  gpu::FrameRing frames_;
  Straightforward path_;
  gpu::Readback readback_;
};

double timeOf(const FrameDesc& desc, int index) {
  return desc.times[static_cast<std::size_t>(index) % desc.times.size()];
}

class Frames {
 public:
  Frames(gpu::Context& context, const Scene& lamp, Tuning tuning)
      : context_(context), lamp_(lamp), tuning_(tuning) {}

  /// Phong shading on both sides: what they disagree on is the edges of polygons that stand for round shapes,
  /// a pixel wide at most, and the sparks of a textbook that turns normals by the sign of N.V.
  void comparePictures(benchmark::State& state, PixelSize size) const {
    // Of sRGB codes / 255. The mean tells a wrong picture from wrong edges: here as if one pixel in 10,000
    // were black in one and white in the other; a lamp dimmer by a tenth makes 1.6e-3. Edges and
    // sparks own the root mean square.
    constexpr double kMaxMean = 1e-4, kMaxRmse = 0.0075;
    const FrameDesc desc{.size = size};
    Renderer renderer(context_);
    StraightforwardFrames theirs(context_, desc);
    for ([[maybe_unused]] auto _ : state) {
      double rmse = 0, mean = 0;
      FrameCounts counts;
      for (const double time : overThePeriod()) {
        const Picture ours = renderer.render(takeSnapshot(lamp_, time, size), desc.options);
        const Comparison difference = compare(ours.image, theirs.picture(time), ComparisonSpace::Srgb8);
        rmse = std::max(rmse, difference.rmse);
        mean = std::max(mean, difference.mean);
        counts.triangles = std::max(counts.triangles, ours.statistics.count.triangles);
        counts.drawCalls = std::max(counts.drawCalls, ours.statistics.count.drawCalls);
      }
      state.counters["rmse"] = rmse;
      state.counters["mean"] = mean;
      state.counters["ours_triangles"] = static_cast<double>(counts.triangles);
      state.counters["theirs_triangles"] = theirs.path().triangles();
      state.counters["ours_draws"] = static_cast<double>(counts.drawCalls);
      state.counters["theirs_draws"] = theirs.path().drawCalls();
      if (!(rmse < kMaxRmse && mean < kMaxMean))
        state.SkipWithError("the two paths do not draw the same picture");
    }
  }

  void untilFinished(benchmark::State& state, const FrameDesc& desc) const {
    if (tuning_ == Tuning::On) tuneAllocator();
    LuxoFrames ours(context_, lamp_, desc);
    StraightforwardFrames theirs(context_, desc);
    sideBySide(
        state, [&](int i) { ours.draw(timeOf(desc, i)); }, [&](int i) { theirs.draw(timeOf(desc, i)); });
  }

  void untilRead(benchmark::State& state, const FrameDesc& desc) const {
    if (tuning_ == Tuning::On) tuneAllocator();
    Renderer ours(context_);
    StraightforwardFrames theirs(context_, desc);
    sideBySide(
        state,
        [&](int i) {
          const Snapshot snapshot = takeSnapshot(lamp_, timeOf(desc, i), desc.size);
          benchmark::DoNotOptimize(ours.render(snapshot, desc.options));
        },
        [&](int i) { benchmark::DoNotOptimize(theirs.picture(timeOf(desc, i))); });
  }

 private:
  gpu::Context& context_;
  const Scene& lamp_;
  Tuning tuning_;
};

using Body = void (Frames::*)(benchmark::State&, const FrameDesc&) const;

std::string nameOf(PixelSize size) { return fmt::format("{}x{}", size.width, size.height); }

}  // namespace

void registerFrames(gpu::Context& context, const Scene& lamp, Tuning tuning) {
  const Frames frames(context, lamp, tuning);
  const std::string group = tuning == Tuning::On ? "frame" : "frame_untuned";
  const auto add = [&](const std::string& name, Body body, const FrameDesc& desc) {
    benchmark::RegisterBenchmark(fmt::format("{}/{}/{}", group, name, nameOf(desc.size)).c_str(),
                                 [=](benchmark::State& state) { (frames.*body)(state, desc); })
        ->UseManualTime()
        ->Iterations(48)
        ->Unit(benchmark::kMillisecond);
  };
  for (const PixelSize size : kSizes) {
    add("phong/period", &Frames::untilFinished, {.size = size, .times = overThePeriod()});
    add("phong/read_back", &Frames::untilRead, {.size = size, .times = overThePeriod()});
    if (tuning == Tuning::Off) continue;

    benchmark::RegisterBenchmark(fmt::format("picture/{}", nameOf(size)).c_str(),
                                 [=](benchmark::State& state) { frames.comparePictures(state, size); })
        ->Iterations(1)
        ->Unit(benchmark::kMillisecond);
    add("phong/half_precision", &Frames::untilFinished,
        {.size = size, .precision = Precision::Half, .times = overThePeriod()});
    for (const Shading shading : {Shading::Flat, Shading::Gouraud, Shading::Phong, Shading::Wireframe})
      for (const int samples : {1, 4})
        add(fmt::format("{}/still_{}x", nameOf(shading), samples), &Frames::untilFinished,
            {.size = size,
             // Shadows are where both can tell them: between vertices, too.
             .options = {.shading = shading, .samples = samples, .shadows = ShadowKinds::ClosedForms}});
  }
}

}  // namespace luxo::bench
