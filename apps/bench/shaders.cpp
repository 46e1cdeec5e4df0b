// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include <optional>
#include <string>

#include "benchmarks.h"
#include "luxo/bench_reload.h"

namespace luxo::bench {
namespace {

constexpr int kEdits = 11;

/// The time is luxo's own. Counters, medians in ms: `total`, `driver`.
void savedToPicture(benchmark::State& state, const std::string& shader) {
  const std::optional<ReloadBench> bench =
      benchReload({}, {.runs = kEdits, .shaders = {shader}}, [](double) { return true; });
  const ReloadRow& row = bench->rows.front();
  auto own = row.own.begin();
  for ([[maybe_unused]] auto _ : state) state.SetIterationTime(*own++ / 1000);
  state.counters["total"] = row.totalMs.median;
  state.counters["driver"] = row.driverMs.median;
}

}  // namespace

void registerShaders() {
  for (const std::string& shader : reloadShaders())
    benchmark::RegisterBenchmark(("shader/saved_to_picture/" + shader).c_str(), savedToPicture, shader)
        ->UseManualTime()
        ->Iterations(kEdits)
        ->Unit(benchmark::kMillisecond);
}

}  // namespace luxo::bench
