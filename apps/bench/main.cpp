// SPDX-License-Identifier: Apache-2.0
// luxo_bench: what luxo costs, next to what the straightforward way costs, in one run.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cstdio>

#include "base/error.h"
#include "benchmarks.h"
#include "gpu/context.h"
#include "luxo_grandpa/lamp.h"
#include "report.h"

int main(int argc, char** argv) {
  using namespace luxo;
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  try {
    gpu::Context context;
    const Scene lamp = luxoGrandpa();
    benchmark::AddCustomContext("device", context.deviceInfo().name);
    // Tuning the process cannot be taken back, so what goes without it goes first.
    bench::registerFrames(context, lamp, bench::Tuning::Off);
    bench::registerFrames(context, lamp, bench::Tuning::On);
    bench::registerSurfaces();
    bench::registerScenes();
    bench::registerModels();
    bench::registerKnotFrames(context);
    bench::registerLayerFrames(context);
    bench::registerStages(lamp);
    bench::registerStart();
    bench::registerShaders();
    bench::Report report;
    benchmark::RunSpecifiedBenchmarks(&report);
    benchmark::Shutdown();
    return report.failed() ? 6 : 0;
  } catch (const Error& error) {
    fmt::print(stderr, "luxo_bench: {}\n{}\n", error.what(), error.hint());
    return error.kind() == ErrorKind::Device ? 4 : 1;
  }
}
