// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "benchmarks.h"
#include "cull/cull.h"
#include "draw/draw_list.h"
#include "image/png.h"
#include "image/srgb.h"
#include "scene/snapshot.h"

namespace luxo::bench {
namespace {

constexpr PixelSize kSize{1280, 720};
constexpr double kTime = 21;

void snapshotLamp(benchmark::State& state, const Scene& lamp) {
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(takeSnapshot(lamp, kTime, kSize));
}

void cullLamp(benchmark::State& state, const Scene& lamp) {
  const Snapshot snapshot = takeSnapshot(lamp, kTime, kSize);
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(cull(snapshot));
}

/// With the meshes in the cache, as in every frame but the first.
void listLamp(benchmark::State& state, const Scene& lamp) {
  const Snapshot snapshot = takeSnapshot(lamp, kTime, kSize);
  const VisibleList visible = cull(snapshot);
  Geometry geometry;
  benchmark::DoNotOptimize(listDraws(snapshot, visible, {}, geometry));
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(listDraws(snapshot, visible, {}, geometry));
}

/// A smooth picture with some detail, since both encoders depend on what they see.
Image testPicture() {
  Image image(kSize.width, kSize.height, 3);
  for (int y = 0; y < kSize.height; ++y)
    for (int x = 0; x < kSize.width; ++x)
      for (int c = 0; c < 3; ++c)
        image.pixel(x, y)[static_cast<std::size_t>(c)] =
            static_cast<float>(0.5 + 0.5 * std::sin(0.01 * x * (c + 1)) * std::cos(0.013 * y));
  return image;
}

void encodeSrgb(benchmark::State& state) {
  const Image image = testPicture();
  std::vector<std::uint8_t> codes(image.samples().size());
  for ([[maybe_unused]] auto _ : state) {
    encodeSrgb8(image.samples(), image.channels(), codes);
    benchmark::DoNotOptimize(codes.data());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(codes.size()));
}

void encodePngFile(benchmark::State& state) {
  const Image image = testPicture();
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(encodePng(image).data());
}

}  // namespace

void registerStages(const Scene& lamp) {
  const auto ofLamp = [&](const char* name, void (*body)(benchmark::State&, const Scene&)) {
    benchmark::RegisterBenchmark(name, [body, &lamp](benchmark::State& state) {
      body(state, lamp);
    })->Unit(benchmark::kMicrosecond);
  };
  ofLamp("lamp/snapshot", snapshotLamp);
  ofLamp("lamp/cull", cullLamp);
  ofLamp("lamp/list_draws", listLamp);
  benchmark::RegisterBenchmark("encode/srgb/1280x720", encodeSrgb)->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("encode/png/1280x720", encodePngFile)->Unit(benchmark::kMillisecond);
}

}  // namespace luxo::bench
