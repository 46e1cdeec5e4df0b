// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <string>
#include <string_view>

#include "benchmarks.h"
#include "luxo_frames.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "side_by_side.h"

namespace luxo::bench {
namespace {

constexpr PixelSize kSize{512, 512};
constexpr int kMany = 8;

/// So many waving sheets, one under the other, each over all of the picture.
Scene sheets(int count, double opacity) {
  std::string nodes;
  for (int i = 0; i < count; ++i)
    nodes +=
        fmt::format(R"({{ "surface": "sheet", "material": "glass", "translate": [0, {}, 0] }}, )", -0.5 * i);
  return buildScene(parseScene(fmt::format(R"_({{ "luxo": 1,
      "materials": {{ "glass": {{ "diffuse": [0.8, 0.3, 0.2], "opacity": {} }} }},
      "surfaces": {{ "sheet": {{ "type": "formula", "u": [-1, 1], "v": [-1, 1],
                               "position": ["6u", "0.15*sin(5u)*cos(4v)", "6v"] }} }},
      "camera": {{ "eye": [0, 4, 2], "look_at": [0, 0, 0], "fov_y": "45deg" }},
      "nodes": [ {} {{ "translate": [-3, 8, 3], "light": {{}} }} ] }})_",
                                           opacity, nodes),
                               "sheets"));
}

/// A named surface, which covers most of the picture.
Scene alone(std::string_view type, double opacity) {
  return buildScene(parseScene(fmt::format(R"_({{ "luxo": 1,
      "materials": {{ "glass": {{ "diffuse": [0.8, 0.3, 0.2], "opacity": {} }} }},
      "surfaces": {{ "it": {{ "type": "{}" }} }},
      "nodes": [ {{ "surface": "it", "material": "glass" }},
                 {{ "translate": [-3, 8, 3], "light": {{}} }} ] }})_",
                                           opacity, type),
                               "glass"));
}

void layers(benchmark::State& state, gpu::Context& context, const Scene& ofOurs, const Scene& ofTheirs) {
  const FrameDesc desc{
      .size = kSize, .options = {.shading = Shading::Exact, .skips = {.unchanged = false}}, .times = {0}};
  LuxoFrames ours(context, ofOurs, desc), theirs(context, ofTheirs, desc);
  sideBySide(
      state, [&](int) { ours.draw(0); }, [&](int) { theirs.draw(0); });
}

}  // namespace

void registerLayerFrames(gpu::Context& context) {
  const auto add = [&](const std::string& name, const Scene& ours, const Scene& theirs) {
    benchmark::RegisterBenchmark(
        name.c_str(),
        [&context, ours, theirs](benchmark::State& state) { layers(state, context, ours, theirs); })
        ->UseManualTime()
        ->Iterations(12)
        ->Unit(benchmark::kMillisecond);
  };
  // A further layer costs (ratio - 1) / 7 of the other frame.
  add("layers/8_over_1", sheets(kMany, 0.5), sheets(1, 0.5));
  add("layers/8_over_opaque", sheets(kMany, 0.5), sheets(1, 1));
  for (const char* type : {"torus", "klein", "teapot"})
    add(fmt::format("layers/{}_over_opaque", type), alone(type, 0.5), alone(type, 1));
}

}  // namespace luxo::bench
