// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <malloc.h>

#include <iterator>
#include <string>

#include "benchmarks.h"
#include "scene/json.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"

namespace luxo::bench {
namespace {

/// A scene file of so many constant nodes, or of nodes that all turn in their own way: about 100 bytes each.
std::string sceneText(std::int64_t nodes, bool moving) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out,
                 "{{ \"luxo\": 1, \"materials\": {{ \"m\": {{ \"diffuse\": 0.5 }} }},\n"
                 "\"surfaces\": {{ \"s\": {{ \"type\": \"sphere\", \"radius\": 1 }} }}, \"nodes\": [\n");
  for (std::int64_t i = 0; i < nodes; ++i) {
    fmt::format_to(out, "{{ \"name\": \"node {}\", \"translate\": [{}, {}, {}]", i, 0.1 * double(i % 1000),
                   0.7 * double(i % 77), -0.3 * double(i % 501));
    if (moving) fmt::format_to(out, ", \"rotate\": {{ \"axis\": [0, 1, 0], \"angle\": \"sin(t + {})\" }}", i);
    fmt::format_to(out, ", \"surface\": \"s\", \"material\": \"m\" }}{}\n", i + 1 < nodes ? "," : "");
  }
  fmt::format_to(out, "] }}\n");
  return fmt::to_string(text);
}

double allocatedBytes() { return double(mallinfo2().uordblks) + double(mallinfo2().hblkhd); }

void readScene(benchmark::State& state) {
  const std::string text = sceneText(state.range(0), false);
  double bytes = 0;
  for ([[maybe_unused]] auto _ : state) {
    const double before = allocatedBytes();
    const SceneFile file = parseScene(text, "bench");
    bytes = allocatedBytes() - before - double(text.size());
    benchmark::DoNotOptimize(file.nodes.data());
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
  state.SetBytesProcessed(state.iterations() * std::int64_t(text.size()));
  state.counters["bytes_per_node"] = bytes / double(state.range(0));
}

void buildNodes(benchmark::State& state, bool moving) {
  const SceneFile file = parseScene(sceneText(state.range(0), moving), "bench");
  double bytes = 0;
  for ([[maybe_unused]] auto _ : state) {
    const double before = allocatedBytes();
    const Scene scene = buildScene(file);
    bytes = allocatedBytes() - before;
    benchmark::DoNotOptimize(scene.nodes().data());
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
  state.counters["bytes_per_node"] = bytes / double(state.range(0));
}

/// From the text of a formula to a surface with its derivatives, topology and sliders.
void buildFormula(benchmark::State& state) {
  const SceneFile file = parseScene(R"_({ "luxo": 1,
    "params": { "lobes": { "value": 5, "range": [1, 12] }, "swell": { "value": 0.28, "range": [0, 0.6] } },
    "surfaces": { "twisted torus": { "type": "formula", "u": [0, "tau"], "v": [0, "tau"],
      "let": { "r": "0.4*(1 + swell*cos(lobes*u - 2v + t))", "ring": "1.1 + r*cos(v)" },
      "position": ["ring*cos(u)", "r*sin(v)", "-ring*sin(u)"] } } })_",
                                    "bench");
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(buildScene(file).version());
}

}  // namespace

void registerScenes() {
  for (const std::int64_t nodes : {10'000, 100'000, 1'000'000})
    benchmark::RegisterBenchmark("scene/read_nodes", readScene)->Arg(nodes)->Unit(benchmark::kMillisecond);
  for (const std::int64_t nodes : {10'000, 100'000, 1'000'000})
    benchmark::RegisterBenchmark("scene/build_nodes", buildNodes, false)
        ->Arg(nodes)
        ->Unit(benchmark::kMillisecond);
  for (const std::int64_t nodes : {10'000, 100'000})
    benchmark::RegisterBenchmark("scene/build_moving_nodes", buildNodes, true)
        ->Arg(nodes)
        ->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("scene/build_formula", buildFormula)->Unit(benchmark::kMicrosecond);
}

}  // namespace luxo::bench
