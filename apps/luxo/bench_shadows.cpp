// SPDX-License-Identifier: Apache-2.0
#include "bench_shadows.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <list>
#include <numeric>

#include "draw/renderer.h"
#include "measured_picture.h"
#include "reference/reference.h"
#include "reference/verification.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"

namespace luxo {
namespace {

using Kind = ShadowWay::Kind;

struct BenchedScene {
  const char* name;
  const char* nodes;  ///< beside the floor and the light
};
/// What stands on a floor of 12 m, in the light of one lamp 8 m above.
constexpr std::array<BenchedScene, 3> kScenes = {{
    {"torus on the ground",
     R"({ "surface": "torus", "translate": [0, 1.12, 0], "rotate": { "axis": [1, 0, 0.4], "angle": "50deg" } })"},
    {"lamp",
     R"({ "surface": "base" }, { "surface": "joint", "translate": [0, 0.4, 0] },
        { "surface": "rod", "translate": [0, 0.4, 0], "rotate": { "axis": [1, 0, 0.6], "angle": "35deg" }, "children": [
          { "surface": "joint", "translate": [0, 2.4, 0] },
          { "surface": "rod", "translate": [0, 2.4, 0], "rotate": { "axis": [1, 0, 0.2], "angle": "-100deg" }, "children": [
            { "surface": "shade", "translate": [0, 2.4, 0] } ] } ] })"},
    {"teapot on its table", R"({ "surface": "teapot" })"},
}};

/// Of the time of a scene: rays, biases, and what is timed; the rest is judging.
constexpr double kTruthPart = 0.1, kBiasPart = 0.5, kTimedPart = 0.3;

constexpr double kRadius = 0.6;  // metres, of a lamp with soft shadows

bool hasRadius(const ShadowWay& way) { return way.kind == Kind::Soft || way.hasRadius; }

Scene sceneOf(const BenchedScene& benched, const ShadowWay& way) {
  std::string light = R"("intensity": 60, "attenuation": "inverse-square")";
  if (way.kind == Kind::Planar) light += R"(, "shadow": "planar", "shadow_plane": "floor")";
  if (way.kind == Kind::DepthMap)
    light += fmt::format(R"(, "shadow": "map", "map": {{ "size": {}, "bias": {}, "slope_bias": {},
                               "normal_offset": {}, "receiver_plane": {}, "pcf": {} }})",
                         way.gridSize, way.bias, way.slopeBias, way.normalOffset, way.receiverPlane, way.pcf);
  if (way.kind == Kind::Exact || way.kind == Kind::Soft) light += R"(, "shadow": "exact")";
  if (hasRadius(way)) light += fmt::format(R"(, "radius": {})", kRadius);
  if (way.kind == Kind::Soft) light += fmt::format(R"(, "shadow_samples": {})", way.points);
  return buildScene(parseScene(fmt::format(R"({{ "luxo": 1, "render": {{ "ambient": 0.1 }},
        "surfaces": {{ "floor": {{ "type": "rectangle", "size": [12, 12] }},
          "torus": {{ "type": "torus", "major": 1, "minor": 0.35 }}, "teapot": {{ "type": "teapot" }},
          "base": {{ "type": "cylinder", "radius": 1, "height": 0.3 }}, "joint": {{ "type": "sphere", "radius": 0.25 }},
          "rod": {{ "type": "cylinder", "radius": 0.1, "height": 2.4 }},
          "shade": {{ "type": "paraboloid", "focal_length": 0.15, "height": 1 }} }},
        "camera": {{ "eye": [4, 6, 8], "look_at": [0.4, 0.8, 0], "fov_y": "45deg" }},
        "nodes": [ {{ "name": "floor", "surface": "floor" }}, {},
                   {{ "translate": [-3, 8, 3], "light": {{ {} }} }} ] }})",
                                           benched.nodes, light),
                               benched.name));
}

/// A way with a renderer of its own, so that what others draw in between changes nothing in it.
struct ShadowContestant {
  ShadowContestant(gpu::Context& context, const BenchedScene& scene, const ShadowWay& way, PixelSize size)
      : row{.scene = scene.name, .way = way},
        snapshot(takeSnapshot(sceneOf(scene, way), 0, size)),
        options{.shadowGridSize = way.gridSize, .skips = {.unchanged = false}},
        renderer(context) {}

  ShadowRow row;
  Snapshot snapshot;
  DrawOptions options;
  Renderer renderer;
  std::vector<double> frameMs = {};

  void drawTimed() {
    const FrameStatistics drawn = renderer.render(snapshot, options).statistics;
    frameMs.push_back(drawn.ms.total - drawn.ms.readback);
    row.shadowPasses = drawn.count.shadowPasses;
    row.rayPx = drawn.error.shadowRaysPx;
  }
  [[nodiscard]] bool hasTakenMuch(double muchMs) const {
    return std::accumulate(frameMs.begin(), frameMs.end(), 0.0) > muchMs;
  }
};

double rmsOf(const Image& image, const ReferencePicture& truth, const std::vector<std::uint32_t>& pixels) {
  double squares = 0;
  std::size_t count = 0;
  for (const std::uint32_t pixel : pixels) {
    const int width = image.width(), x = static_cast<int>(pixel) % width, y = static_cast<int>(pixel) / width;
    if (truth.number[pixel] == 0) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      const double off = image.pixel(x, y)[c] - truth.color.pixel(x, y)[c];
      squares += off * off;
      ++count;
    }
  }
  return std::sqrt(squares / static_cast<double>(std::max<std::size_t>(count, 1)));
}

constexpr std::array<BiasKind, 3> kBiasKinds = {BiasKind::Constant, BiasKind::Slope, BiasKind::NormalOffset};

ShadowWay depthMap(BiasKind kind, double amount, int mapSize) {
  ShadowWay way{.kind = Kind::DepthMap, .gridSize = mapSize};
  (kind == BiasKind::Constant ? way.bias
   : kind == BiasKind::Slope  ? way.slopeBias
                              : way.normalOffset) = amount;
  return way;
}

/// What each bias leaves wrong in maps of each size; nothing once `goesOn` says no.
std::optional<std::vector<BiasRow>> sweepBiases(gpu::Context& context, const BenchedScene& scene,
                                                const Snapshot& exact, const ReferencePicture& truth,
                                                const ShadowPlan& plan,
                                                const std::function<bool(double)>& goesOn) {
  std::vector<BiasRow> rows;
  const std::size_t all = (plan.constantBiases.size() + 2 * plan.texelBiases.size()) * plan.mapSizes.size();
  Renderer renderer(context);
  for (const BiasKind kind : kBiasKinds)
    for (const double amount : kind == BiasKind::Constant ? plan.constantBiases : plan.texelBiases)
      for (const int size : plan.mapSizes) {
        if (!goesOn(static_cast<double>(rows.size()) / static_cast<double>(all))) return std::nullopt;
        const Snapshot snapshot = takeSnapshot(sceneOf(scene, depthMap(kind, amount, size)), 0, plan.size);
        rows.push_back(
            {.scene = scene.name,
             .kind = kind,
             .amount = amount,
             .mapSize = size,
             .wrongPx = verify(exact, truth, measure(renderer, snapshot, {}).picture).wrong.light});
      }
  return rows;
}

int middlingSize(const ShadowPlan& plan) { return plan.mapSizes[plan.mapSizes.size() / 2]; }

/// The amount that leaves the fewest wrong pixels in a map of middling size.
double tuned(const std::vector<BiasRow>& rows, BiasKind kind, const ShadowPlan& plan) {
  const BiasRow* best = nullptr;
  for (const BiasRow& row : rows)
    if (row.kind == kind && row.mapSize == middlingSize(plan) && (!best || row.wrongPx < best->wrongPx))
      best = &row;
  return best->amount;
}

std::vector<ShadowWay> waysOf(const ShadowPlan& plan, double slopeBias, double normalOffset) {
  std::vector<ShadowWay> ways{{.kind = Kind::None}};
  for (const int size : {32, 64, 128}) ways.push_back({.kind = Kind::Exact, .gridSize = size});
  for (const int size : plan.mapSizes) {
    const ShadowWay sloped = depthMap(BiasKind::Slope, slopeBias, size);
    ways.push_back(depthMap(BiasKind::Constant, 0, size));
    ways.push_back(depthMap(BiasKind::Constant, kLessonBias, size));
    ways.push_back(sloped);
    ways.push_back(depthMap(BiasKind::NormalOffset, normalOffset, size));
    ways.push_back({.kind = Kind::DepthMap, .gridSize = size, .receiverPlane = true, .pcf = 3});
    ways.push_back(sloped);
    ways.back().pcf = 3;
    if (size != middlingSize(plan)) continue;
    ways.push_back(sloped);
    ways.back().hasRadius = true;
  }
  ways.push_back({.kind = Kind::Planar});
  for (const int points : plan.points) ways.push_back({.kind = Kind::Soft, .points = points});
  return ways;
}

void judge(std::list<ShadowContestant>& contestants, const BenchedScene& scene, const Snapshot& exact,
           const ReferencePicture& truth, const ShadowPlan& plan) {
  const std::vector<std::uint32_t> pixels = spreadPixels(plan.size, plan.truthPixels);
  const ReferencePicture soft =
      castPicture(takeSnapshot(sceneOf(scene, {.kind = Kind::Soft, .points = kTruthPoints}), 0, plan.size),
                  {.pixels = pixels});
  for (ShadowContestant& c : contestants) {
    if (hasRadius(c.row.way))
      c.row.rms = rmsOf(c.renderer.render(c.snapshot, c.options).image, soft, pixels);
    else if (c.row.way.kind != Kind::None)
      c.row.wrongPx = verify(exact, truth, measure(c.renderer, c.snapshot, c.options).picture).wrong.light;
  }
}

}  // namespace

std::string nameOf(const ShadowWay& way) {
  switch (way.kind) {
    case Kind::Exact:
      return fmt::format("exact, map of {}", way.gridSize);
    case Kind::DepthMap:
      return fmt::format("depth map of {}{}{}{}{}{}{}", way.gridSize,
                         way.bias > 0 ? fmt::format(", bias {}", way.bias) : "",
                         way.slopeBias > 0 ? fmt::format(", slope bias {}", way.slopeBias) : "",
                         way.normalOffset > 0 ? fmt::format(", normal offset {}", way.normalOffset) : "",
                         way.receiverPlane ? ", receiver plane" : "",
                         way.pcf > 1 ? fmt::format(", pcf {}", way.pcf) : "", way.hasRadius ? ", pcss" : "");
    case Kind::Planar:
      return "planar";
    case Kind::Soft:
      return fmt::format("soft, {} points", way.points);
    case Kind::None:
      break;
  }
  return "none";
}

const char* nameOf(BiasKind kind) {
  switch (kind) {
    case BiasKind::Slope:
      return "slope bias";
    case BiasKind::NormalOffset:
      return "normal offset";
    case BiasKind::Constant:
      break;
  }
  return "bias";
}

std::optional<ShadowBench> benchShadows(gpu::Context& context, const ShadowPlan& plan,
                                        const std::function<bool(double)>& goesOn) {
  ShadowBench bench{
      .machine = fingerprintOf(context.deviceInfo()), .size = plan.size, .rows = {}, .biases = {}};
  for (std::size_t i = 0; i < kScenes.size(); ++i) {
    const Snapshot exact = takeSnapshot(sceneOf(kScenes[i], {.kind = Kind::Exact}), 0, plan.size);
    const ReferencePicture truth = castPicture(exact);
    const auto goesOnAt = [&](double part) {
      return goesOn((static_cast<double>(i) + part) / kScenes.size());
    };
    const auto biases = sweepBiases(context, kScenes[i], exact, truth, plan,
                                    [&](double part) { return goesOnAt(kTruthPart + kBiasPart * part); });
    if (!biases) return std::nullopt;
    bench.biases.insert(bench.biases.end(), biases->begin(), biases->end());
    std::list<ShadowContestant> contestants;  // a renderer does not move
    for (const ShadowWay& way :
         waysOf(plan, tuned(*biases, BiasKind::Slope, plan), tuned(*biases, BiasKind::NormalOffset, plan)))
      contestants.emplace_back(context, kScenes[i], way, plan.size);
    for (int run = -1; run < plan.runs; ++run)
      for (ShadowContestant& c : contestants) {
        if (!goesOnAt(kTruthPart + kBiasPart + kTimedPart * (run + 1) / (plan.runs + 1))) return std::nullopt;
        if (run > 0 && c.hasTakenMuch(plan.muchMs)) continue;
        c.drawTimed();
        if (run < 0) c.frameMs.clear();  // pipelines, meshes and maps were made
      }
    judge(contestants, kScenes[i], exact, truth, plan);
    for (ShadowContestant& c : contestants) {
      c.row.runs = static_cast<int>(c.frameMs.size());
      c.row.frameMs = typicalOf(c.frameMs);
      bench.rows.push_back(std::move(c.row));
    }
  }
  return bench;
}

}  // namespace luxo
