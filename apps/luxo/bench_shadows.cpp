// SPDX-License-Identifier: Apache-2.0
#include "bench_shadows.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <list>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string_view>

#include "bench_page.h"
#include "draw/renderer.h"
#include "measured_picture.h"
#include "reference/reference.h"
#include "reference/verification.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"

namespace luxo {
namespace {

using Kind = ShadowWay::Kind;
using Json = nlohmann::ordered_json;

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

constexpr double kRadius = 0.6;  // metres, of a lamp with soft shadows

Scene sceneOf(const BenchedScene& benched, const ShadowWay& way) {
  std::string light = R"("intensity": 60, "attenuation": "inverse-square")";
  if (way.kind == Kind::Planar) light += R"(, "shadow": "planar", "shadow_plane": "floor")";
  if (way.kind == Kind::DepthMap)
    light +=
        fmt::format(R"(, "shadow": "map", "map": {{ "size": {}, "bias": {}, "slope_bias": {}, "pcf": {} }})",
                    way.gridSize, way.bias, way.slopeBias, way.pcf);
  if (way.kind == Kind::Exact || way.kind == Kind::Soft) light += R"(, "shadow": "exact")";
  if (way.kind == Kind::Soft)
    light += fmt::format(R"(, "radius": {}, "shadow_samples": {})", kRadius, way.points);
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

/// The slope bias that leaves the fewest wrong pixels, of some, in a map of middling size.
double tunedSlopeBias(gpu::Context& context, const BenchedScene& scene, const ReferencePicture& truth,
                      const ShadowPlan& plan) {
  const Snapshot exact = takeSnapshot(sceneOf(scene, {.kind = Kind::Exact}), 0, plan.size);
  const int size = plan.mapSizes[plan.mapSizes.size() / 2];
  Renderer renderer(context);
  double best = 0;
  std::uint64_t fewest = std::numeric_limits<std::uint64_t>::max();
  for (const double slope : {0.5, 0.75, 1.0, 1.5, 2.0, 3.0}) {
    const ShadowWay way{.kind = Kind::DepthMap, .gridSize = size, .slopeBias = slope};
    const Snapshot snapshot = takeSnapshot(sceneOf(scene, way), 0, plan.size);
    const std::uint64_t wrong = verify(exact, truth, measure(renderer, snapshot, {}).picture).wrong.light;
    if (wrong >= fewest) continue;
    fewest = wrong;
    best = slope;
  }
  return best;
}

std::vector<ShadowWay> waysOf(const ShadowPlan& plan, double slopeBias) {
  std::vector<ShadowWay> ways{{.kind = Kind::None}};
  for (const int size : {32, 64, 128}) ways.push_back({.kind = Kind::Exact, .gridSize = size});
  for (const int size : plan.mapSizes) {
    ways.push_back({.kind = Kind::DepthMap, .gridSize = size});
    ways.push_back({.kind = Kind::DepthMap, .gridSize = size, .bias = kLessonBias});
    ways.push_back({.kind = Kind::DepthMap, .gridSize = size, .slopeBias = slopeBias});
    ways.push_back({.kind = Kind::DepthMap, .gridSize = size, .slopeBias = slopeBias, .pcf = 3});
  }
  ways.push_back({.kind = Kind::Planar});
  for (const int points : plan.points) ways.push_back({.kind = Kind::Soft, .points = points});
  return ways;
}

void judge(std::list<ShadowContestant>& contestants, const BenchedScene& scene, const ReferencePicture& truth,
           const ShadowPlan& plan) {
  const Snapshot exact = takeSnapshot(sceneOf(scene, {.kind = Kind::Exact}), 0, plan.size);
  const std::vector<std::uint32_t> pixels = spreadPixels(plan.size, plan.truthPixels);
  const ReferencePicture soft =
      castPicture(takeSnapshot(sceneOf(scene, {.kind = Kind::Soft, .points = kTruthPoints}), 0, plan.size),
                  {.pixels = pixels});
  for (ShadowContestant& c : contestants) {
    if (c.row.way.kind == Kind::Soft)
      c.row.rms = rmsOf(c.renderer.render(c.snapshot, c.options).image, soft, pixels);
    else if (c.row.way.kind != Kind::None)
      c.row.wrongPx = verify(exact, truth, measure(c.renderer, c.snapshot, c.options).picture).wrong.light;
  }
}

/// Time over that without shadows in the same scene.
double ratioOf(const ShadowBench& bench, const ShadowRow& row) {
  const auto none = std::ranges::find_if(bench.rows, [&](const ShadowRow& other) {
    return other.scene == row.scene && other.way.kind == Kind::None;
  });
  return row.frameMs.median / none->frameMs.median;
}

std::string textOf(const auto& value, const char* format) {
  return value ? fmt::format(fmt::runtime(format), *value) : std::string();
}

}  // namespace

std::string nameOf(const ShadowWay& way) {
  switch (way.kind) {
    case Kind::Exact:
      return fmt::format("exact, map of {}", way.gridSize);
    case Kind::DepthMap:
      return fmt::format("depth map of {}{}{}{}", way.gridSize,
                         way.bias > 0 ? fmt::format(", bias {}", way.bias) : "",
                         way.slopeBias > 0 ? fmt::format(", slope bias {}", way.slopeBias) : "",
                         way.pcf > 1 ? fmt::format(", pcf {}", way.pcf) : "");
    case Kind::Planar:
      return "planar";
    case Kind::Soft:
      return fmt::format("soft, {} points", way.points);
    case Kind::None:
      break;
  }
  return "none";
}

std::optional<ShadowBench> benchShadows(gpu::Context& context, const ShadowPlan& plan,
                                        const std::function<bool(double)>& goesOn) {
  ShadowBench bench{.machine = fingerprintOf(context.deviceInfo()), .size = plan.size, .rows = {}};
  for (std::size_t i = 0; i < kScenes.size(); ++i) {
    const ReferencePicture truth =
        castPicture(takeSnapshot(sceneOf(kScenes[i], {.kind = Kind::Exact}), 0, plan.size));
    const double slopeBias = tunedSlopeBias(context, kScenes[i], truth, plan);
    std::list<ShadowContestant> contestants;  // a renderer does not move
    for (const ShadowWay& way : waysOf(plan, slopeBias))
      contestants.emplace_back(context, kScenes[i], way, plan.size);
    for (int run = -1; run < plan.runs; ++run)
      for (ShadowContestant& c : contestants) {
        const double part = 0.7 * (run + 1) / (plan.runs + 1);
        if (!goesOn((static_cast<double>(i) + part) / kScenes.size())) return std::nullopt;
        if (run > 0 && c.hasTakenMuch(plan.muchMs)) continue;
        c.drawTimed();
        if (run < 0) c.frameMs.clear();  // pipelines, meshes and maps were made
      }
    judge(contestants, kScenes[i], truth, plan);
    for (ShadowContestant& c : contestants) {
      c.row.runs = static_cast<int>(c.frameMs.size());
      c.row.frameMs = typicalOf(c.frameMs);
      bench.rows.push_back(std::move(c.row));
    }
  }
  return bench;
}

std::string shadowText(const ShadowBench& bench) {
  std::string text = fmt::format("{:<22}{:<39}{:>5}{:>10}{:>9}{:>8}{:>10}{:>11}\n", "scene", "shadows",
                                 "runs", "frame ms", "to none", "passes", "wrong px", "rms");
  for (const ShadowRow& row : bench.rows)
    text += fmt::format("{:<22}{:<39}{:>5}{:>10.1f}{:>9.2f}{:>8}{:>10}{:>11}\n", row.scene, nameOf(row.way),
                        row.runs, row.frameMs.median, ratioOf(bench, row), row.shadowPasses,
                        textOf(row.wrongPx, "{}"), textOf(row.rms, "{:.2e}"));
  return text;
}

std::string shadowCsv(const ShadowBench& bench) {
  std::string csv =
      "scene,shadows,map_size,bias,slope_bias,pcf,points,runs,frame_ms,frame_ms_p10,frame_ms_p90,to_none,"
      "shadow_passes,"
      "shadow_rays_px,wrong_px,rms\n";
  for (const ShadowRow& row : bench.rows)
    csv += fmt::format("{},\"{}\",{},{},{},{},{},{},{:.3f},{:.3f},{:.3f},{:.4f},{},{},{},{}\n", row.scene,
                       nameOf(row.way), row.way.kind == Kind::None ? 0 : row.way.gridSize, row.way.bias,
                       row.way.slopeBias, row.way.pcf, row.way.points, row.runs, row.frameMs.median,
                       row.frameMs.p10, row.frameMs.p90, ratioOf(bench, row), row.shadowPasses, row.rayPx,
                       textOf(row.wrongPx, "{}"), textOf(row.rms, "{:.6g}"));
  return csv;
}

std::string shadowJson(const ShadowBench& bench) {
  Json machine = Json::object(), rows = Json::array();
  for (const auto& [name, value] : bench.machine) machine[name] = value;
  for (const ShadowRow& row : bench.rows)
    rows.push_back({{"scene", row.scene},
                    {"shadows", nameOf(row.way)},
                    {"map_size", row.way.gridSize},
                    {"bias", row.way.bias},
                    {"slope_bias", row.way.slopeBias},
                    {"pcf", row.way.pcf},
                    {"points", row.way.points},
                    {"runs", row.runs},
                    {"frame_ms", row.frameMs.median},
                    {"frame_ms_p10", row.frameMs.p10},
                    {"frame_ms_p90", row.frameMs.p90},
                    {"to_none", ratioOf(bench, row)},
                    {"shadow_passes", row.shadowPasses},
                    {"shadow_rays_px", row.rayPx},
                    {"wrong_px", row.wrongPx ? Json(*row.wrongPx) : Json()},
                    {"rms", row.rms ? Json(*row.rms) : Json()}});
  const Json json = {{"luxo", LUXO_VERSION},
                     {"bench_shadows", 1},
                     {"machine", std::move(machine)},
                     {"size", {bench.size.width, bench.size.height}},
                     {"rows", std::move(rows)}};
  return json.dump(2) + "\n";
}

std::string shadowScript(const ShadowBench& bench) {
  constexpr std::array<std::string_view, 3> kColours = {"#0072b2", "#d55e00", "#009e73"};
  constexpr double kNoPixel = 0.5;  // where a logarithm has no place for 0
  std::string script =
      "set terminal svg size 1500,560 font 'sans-serif,13' background '#ffffff'\nset encoding utf8\n"
      "set grid lc rgb '#dddddd'\nset logscale xy\nset format xy '%g'\nset key top right noenhanced\n";
  std::string data, overTime, overSize, soft;
  for (std::size_t i = 0; i < kScenes.size(); ++i) {
    std::string exact, depth, planar, plain, lesson, tuned, rms;
    for (const ShadowRow& row : bench.rows) {
      if (row.scene != kScenes[i].name) continue;
      const ShadowWay& way = row.way;
      if (row.rms) rms += fmt::format("{} {}\n", way.points, *row.rms);
      if (!row.wrongPx) continue;
      const double wrong = std::max(static_cast<double>(*row.wrongPx), kNoPixel);
      const bool isTuned = way.kind == Kind::DepthMap && way.slopeBias > 0 && way.pcf == 1;
      const std::string timed = fmt::format("{} {}\n", row.frameMs.median, wrong),
                        sized = fmt::format("{} {}\n", way.gridSize, wrong);
      if (way.kind == Kind::Exact) exact += timed;
      if (way.kind == Kind::Planar) planar += timed;
      if (isTuned) depth += timed;
      if (isTuned) tuned += sized;
      if (way.kind == Kind::DepthMap && way.bias > 0) lesson += sized;
      if (way.kind == Kind::DepthMap && way.bias == 0 && way.slopeBias == 0) plain += sized;
    }
    for (const auto& [name, points] : {std::pair{"e", exact},
                                       {"d", depth},
                                       {"p", planar},
                                       {"n", plain},
                                       {"l", lesson},
                                       {"t", tuned},
                                       {"s", rms}})
      data += fmt::format("${}{} << EOD\n{}EOD\n", name, i, points);
    const char* comma = i > 0 ? ", " : "";
    overTime += fmt::format(
        "{0}$e{1} with points pt 7 lc rgb '{2}' title '{3}: exact', $d{1} with linespoints pt 6 lc rgb '{2}' "
        "title 'depth maps, tuned', $p{1} with points pt 4 lc rgb '{2}' title 'planar'",
        comma, i, kColours[i], kScenes[i].name);
    overSize += fmt::format(
        "{0}$n{1} with linespoints pt 2 dt 3 lc rgb '{2}' title '{3}: no bias', $l{1} with linespoints pt 6 "
        "dt 2 "
        "lc rgb '{2}' title 'bias {4}', $t{1} with linespoints pt 7 lc rgb '{2}' title 'slope bias, tuned'",
        comma, i, kColours[i], kScenes[i].name, kLessonBias);
    soft += fmt::format("{0}$s{1} with linespoints pt 7 lc rgb '{2}' title '{3}'", comma, i, kColours[i],
                        kScenes[i].name);
  }
  script += data;
  script += fmt::format("set multiplot layout 1,3 title 'luxo: shadows, {} x {}'\n", bench.size.width,
                        bench.size.height);
  script += "set title 'wrong pixels against rays (0 is drawn at 0.5)'\nset xlabel 'time of a frame (ms)'\n";
  script += "set yrange [0.3:1e6]\nplot " + overTime + "\n";
  script +=
      "set title 'wrong pixels of depth maps'\nset xlabel 'texels along a side'\nplot " + overSize + "\n";
  script += fmt::format(
      "set title 'soft shadows: rms difference from {} points'\nset xlabel 'points'\nset yrange [*:*]\nplot "
      "{}\n",
      kTruthPoints, soft);
  return script + "unset multiplot\n";
}

std::string shadowPage(const ShadowBench& bench, const std::string& plot) {
  std::string body = fmt::format(
      "<p>One lamp over a floor of 12 m, {} x {} pixels. <i>to none</i>: the time of a frame over that of "
      "the "
      "same scene without shadows, timed in turns; certified rays and the audit included. <i>wrong px</i>: "
      "pixels "
      "that see the light where it is hidden, or the other way round, against rays in double precision. "
      "Depth "
      "maps are tuned for each scene: of some slope biases the one with the fewest wrong pixels.</p>\n",
      bench.size.width, bench.size.height);
  if (!plot.empty()) body += plotOf(plot, "wrong pixels over time and over the size of maps; soft shadows");
  TextTable table{.head = {"scene", "shadows", "runs", "frame ms", "to none", "passes", "wrong px", "rms"},
                  .rows = {}};
  for (const ShadowRow& row : bench.rows)
    table.rows.push_back({row.scene, nameOf(row.way), fmt::format("{}", row.runs),
                          fmt::format("{:.1f}", row.frameMs.median),
                          fmt::format("{:.2f}", ratioOf(bench, row)), fmt::format("{}", row.shadowPasses),
                          textOf(row.wrongPx, "{}"), textOf(row.rms, "{:.2e}")});
  body += tableOf(table);
  TextTable machine{.head = {"measured on", ""}, .rows = {}};
  for (const auto& [name, value] : bench.machine) machine.rows.push_back({name, value});
  return pageOf("luxo: shadows", body + tableOf(machine));
}

}  // namespace luxo
