// SPDX-License-Identifier: Apache-2.0
#include "bench_shadow_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "bench_page.h"
#include "scene/light.h"
#include "text_table.h"

namespace luxo {
namespace {

using Kind = ShadowWay::Kind;
using Json = nlohmann::ordered_json;

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

/// In the order of the rows.
std::vector<std::string> scenesOf(const ShadowBench& bench) {
  std::vector<std::string> names;
  for (const ShadowRow& row : bench.rows)
    if (names.empty() || names.back() != row.scene) names.push_back(row.scene);
  return names;
}

int mapSizeOf(const ShadowWay& way) { return way.kind == Kind::None ? 0 : way.gridSize; }

bool isUnbiased(const ShadowWay& way) {
  return way.kind == Kind::DepthMap && way.bias == 0 && way.slopeBias == 0 && way.normalOffset == 0 &&
         !way.receiverPlane;
}

int smallestMap(const ShadowBench& bench) { return bench.biases.front().mapSize; }
int largestMap(const ShadowBench& bench) {
  return std::ranges::max_element(bench.biases, {}, &BiasRow::mapSize)->mapSize;
}

/// That of a light whose size is not given, where it was drawn.
int usualMap(const ShadowBench& bench) {
  const int usual = static_cast<int>(ShadowMap{}.size);
  return std::ranges::find(bench.biases, usual, &BiasRow::mapSize) != bench.biases.end() ? usual
                                                                                         : largestMap(bench);
}

TextTable waysTable(const ShadowBench& bench) {
  TextTable table{.head = {"scene", "shadows", "runs", "frame ms", "to none", "passes", "wrong px", "rms"},
                  .rows = {}};
  for (const ShadowRow& row : bench.rows)
    table.rows.push_back({row.scene, nameOf(row.way), fmt::format("{}", row.runs),
                          fmt::format("{:.1f}", row.frameMs.median),
                          fmt::format("{:.2f}", ratioOf(bench, row)), fmt::format("{}", row.shadowPasses),
                          textOf(row.wrongPx, "{}"), textOf(row.rms, "{:.2e}")});
  return table;
}

/// Wrong pixels of depth maps: a row for each bias of a scene, a column for each size.
TextTable biasTable(const ShadowBench& bench) {
  TextTable table{.head = {"scene", "bias"}, .rows = {}};
  for (std::size_t i = 0; i < bench.biases.size();) {
    const BiasRow& first = bench.biases[i];
    std::vector<std::string> cells = {first.scene, fmt::format("{} {}{}", nameOf(first.kind), first.amount,
                                                               first.kind == BiasKind::Constant ? " m" : "")};
    const bool isHead = table.rows.empty();
    do {
      if (isHead) table.head.push_back(fmt::format("{} texels", bench.biases[i].mapSize));
      cells.push_back(fmt::format("{}", bench.biases[i].wrongPx));
      ++i;
    } while (i < bench.biases.size() && bench.biases[i].mapSize > bench.biases[i - 1].mapSize);
    table.rows.push_back(std::move(cells));
  }
  return table;
}

/// Told apart by people who see no red or no green, too (Okabe and Ito's palette).
constexpr std::array<std::string_view, 3> kColours = {"#0072b2", "#d55e00", "#009e73"};

struct Curve {
  std::string title, style;  ///< gnuplot's
  std::string points = {};   ///< x y

  void add(double x, double y) { points += fmt::format("{} {}\n", x, y); }
  void addPixels(double x, std::uint64_t pixels) {
    constexpr double kNoPixel = 0.5;  // where a logarithm has no place for 0
    add(x, std::max(static_cast<double>(pixels), kNoPixel));
  }
};

/// One plot of a multiplot.
std::string panel(const std::string& title, const std::string& xLabel, const std::vector<Curve>& curves) {
  std::string data, plots;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    data += fmt::format("$d{} << EOD\n{}EOD\n", i, curves[i].points);
    plots += fmt::format("{}$d{} with {} title '{}'", i > 0 ? ", " : "", i, curves[i].style, curves[i].title);
  }
  return fmt::format("{}set title '{}'\nset xlabel '{}'\nplot {}\n", data, title, xLabel, plots);
}

}  // namespace

std::string shadowText(const ShadowBench& bench) {
  return fmt::format("{}\nwrong pixels of depth maps\n{}", inColumns(waysTable(bench)),
                     inColumns(biasTable(bench)));
}

std::string shadowCsv(const ShadowBench& bench) {
  std::string csv =
      "scene,shadows,map_size,bias,slope_bias,normal_offset,receiver_plane,pcf,points,radius,runs,frame_ms,"
      "frame_ms_p10,frame_ms_p90,to_none,shadow_passes,shadow_rays_px,wrong_px,rms\n";
  for (const ShadowRow& row : bench.rows) {
    const ShadowWay& way = row.way;
    csv += fmt::format("{},\"{}\",{},{},{},{},{},{},{},{},{},", row.scene, nameOf(way), mapSizeOf(way),
                       way.bias, way.slopeBias, way.normalOffset, way.receiverPlane ? 1 : 0, way.pcf,
                       way.points, way.hasRadius ? 1 : 0, row.runs);
    csv += fmt::format("{:.3f},{:.3f},{:.3f},{:.4f},{},{},{},{}\n", row.frameMs.median, row.frameMs.p10,
                       row.frameMs.p90, ratioOf(bench, row), row.shadowPasses, row.rayPx,
                       textOf(row.wrongPx, "{}"), textOf(row.rms, "{:.6g}"));
  }
  return csv;
}

std::string biasCsv(const ShadowBench& bench) {
  std::string csv = "scene,bias,amount,map_size,wrong_px\n";
  for (const BiasRow& row : bench.biases)
    csv += fmt::format("{},{},{},{},{}\n", row.scene, nameOf(row.kind), row.amount, row.mapSize, row.wrongPx);
  return csv;
}

std::string shadowJson(const ShadowBench& bench) {
  Json machine = Json::object(), rows = Json::array(), biases = Json::array();
  for (const auto& [name, value] : bench.machine) machine[name] = value;
  for (const ShadowRow& row : bench.rows)
    rows.push_back({{"scene", row.scene},
                    {"shadows", nameOf(row.way)},
                    {"map_size", mapSizeOf(row.way)},
                    {"bias", row.way.bias},
                    {"slope_bias", row.way.slopeBias},
                    {"normal_offset", row.way.normalOffset},
                    {"receiver_plane", row.way.receiverPlane},
                    {"pcf", row.way.pcf},
                    {"points", row.way.points},
                    {"radius", row.way.hasRadius},
                    {"runs", row.runs},
                    {"frame_ms", row.frameMs.median},
                    {"frame_ms_p10", row.frameMs.p10},
                    {"frame_ms_p90", row.frameMs.p90},
                    {"to_none", ratioOf(bench, row)},
                    {"shadow_passes", row.shadowPasses},
                    {"shadow_rays_px", row.rayPx},
                    {"wrong_px", row.wrongPx ? Json(*row.wrongPx) : Json()},
                    {"rms", row.rms ? Json(*row.rms) : Json()}});
  for (const BiasRow& row : bench.biases)
    biases.push_back({{"scene", row.scene},
                      {"bias", nameOf(row.kind)},
                      {"amount", row.amount},
                      {"map_size", row.mapSize},
                      {"wrong_px", row.wrongPx}});
  const Json json = {{"luxo", LUXO_VERSION},          {"bench_shadows", 1},
                     {"machine", std::move(machine)}, {"size", {bench.size.width, bench.size.height}},
                     {"rows", std::move(rows)},       {"biases", std::move(biases)}};
  return json.dump(2) + "\n";
}

std::string shadowMarkdown(const ShadowBench& bench) {
  struct Column {
    std::string head;
    std::function<bool(const ShadowWay&)> holds;
  };
  const int size = usualMap(bench);
  const auto isMap = [&](const ShadowWay& way) { return way.kind == Kind::DepthMap && way.gridSize == size; };
  std::vector<Column> columns = {
      {"exact, map of 64",
       [](const ShadowWay& way) { return way.kind == Kind::Exact && way.gridSize == 64; }},
      {fmt::format("depth map of {}", size),
       [&](const ShadowWay& way) { return isMap(way) && isUnbiased(way); }},
      {"slope bias, tuned",
       [&](const ShadowWay& way) {
         return isMap(way) && way.slopeBias > 0 && way.pcf == 1 && !way.hasRadius;
       }},
      {"and pcf 3", [&](const ShadowWay& way) { return isMap(way) && way.slopeBias > 0 && way.pcf == 3; }},
      {"planar", [](const ShadowWay& way) { return way.kind == Kind::Planar; }}};
  std::set<int> points;
  for (const ShadowRow& row : bench.rows)
    if (row.way.kind == Kind::Soft && row.way.points > 1) points.insert(row.way.points);
  for (const int count : points)
    columns.push_back({fmt::format("soft, {} points", count), [count](const ShadowWay& way) {
                         return way.kind == Kind::Soft && way.points == count;
                       }});
  TextTable table{.head = {""}, .rows = {}};
  for (const Column& column : columns) table.head.push_back(column.head);
  for (const std::string& scene : scenesOf(bench)) {
    table.rows.push_back({scene});
    for (const Column& column : columns) {
      const auto row = std::ranges::find_if(
          bench.rows, [&](const ShadowRow& r) { return r.scene == scene && column.holds(r.way); });
      const double ratio = ratioOf(bench, *row);
      const std::string wrong =
          row->rms ? fmt::format("{:.0e}", *row->rms) : fmt::format("{} px", *row->wrongPx);
      table.rows.back().push_back(fmt::format("{:.{}f}, {}", ratio, ratio < 10 ? 1 : 0, wrong));
    }
  }
  return inMarkdown(table);
}

std::string shadowScript(const ShadowBench& bench) {
  std::vector<Curve> overTime, overSize, overPoints;
  std::array<std::vector<Curve>, 3> overBias;
  const std::vector<std::string> scenes = scenesOf(bench);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const std::string look = fmt::format("lc rgb '{}'", kColours[i % kColours.size()]);
    Curve exact{scenes[i] + ": exact", "points pt 7 " + look}, planar{"planar", "points pt 4 " + look},
        slopeTime{"depth maps, slope bias", "linespoints pt 6 " + look},
        plain{scenes[i] + ": no bias", "linespoints pt 2 dt 3 " + look},
        lesson{fmt::format("bias {}", kLessonBias), "linespoints pt 6 dt 2 " + look},
        slope{"slope bias, tuned", "linespoints pt 7 " + look}, soft{scenes[i], "linespoints pt 7 " + look};
    for (const ShadowRow& row : bench.rows) {
      if (row.scene != scenes[i]) continue;
      const ShadowWay& way = row.way;
      if (way.kind == Kind::Soft) soft.add(way.points, *row.rms);
      if (!row.wrongPx) continue;
      if (way.kind == Kind::Exact) exact.addPixels(row.frameMs.median, *row.wrongPx);
      if (way.kind == Kind::Planar) planar.addPixels(row.frameMs.median, *row.wrongPx);
      if (way.kind != Kind::DepthMap || way.pcf > 1) continue;
      if (way.slopeBias > 0) slopeTime.addPixels(row.frameMs.median, *row.wrongPx);
      if (way.slopeBias > 0) slope.addPixels(way.gridSize, *row.wrongPx);
      if (way.bias > 0) lesson.addPixels(way.gridSize, *row.wrongPx);
      if (isUnbiased(way)) plain.addPixels(way.gridSize, *row.wrongPx);
    }
    for (Curve* curve : {&exact, &slopeTime, &planar}) overTime.push_back(std::move(*curve));
    for (Curve* curve : {&plain, &lesson, &slope}) overSize.push_back(std::move(*curve));
    overPoints.push_back(std::move(soft));
    for (const int size : {smallestMap(bench), largestMap(bench)})
      for (std::size_t kind = 0; kind < overBias.size(); ++kind) {
        Curve curve{fmt::format("{}, {} texels", scenes[i], size),
                    fmt::format("linespoints {} {}", look, size == largestMap(bench) ? "pt 7" : "pt 6 dt 2")};
        for (const BiasRow& row : bench.biases)
          if (row.scene == scenes[i] && row.mapSize == size && static_cast<std::size_t>(row.kind) == kind &&
              row.amount > 0)
            curve.addPixels(row.amount, row.wrongPx);
        overBias[kind].push_back(std::move(curve));
      }
  }
  std::string script =
      "set terminal svg size 1500,1000 font 'sans-serif,13' background '#ffffff'\nset encoding utf8\n"
      "set grid lc rgb '#dddddd'\nset logscale xy\nset format xy '%g'\nset key top right noenhanced\n";
  script += fmt::format("set multiplot layout 2,3 title 'luxo: shadows, {} x {}'\nset yrange [0.3:1e6]\n",
                        bench.size.width, bench.size.height);
  script += panel("wrong pixels against rays (0 is drawn at 0.5)", "time of a frame (ms)", overTime);
  script += panel("wrong pixels of depth maps", "texels along a side", overSize);
  script += "set yrange [*:*]\n";
  script +=
      panel(fmt::format("soft shadows: rms difference from {} points", kTruthPoints), "points", overPoints);
  script += "set yrange [0.3:1e6]\n";
  script += panel("wrong pixels of depth maps", "constant bias (m)", overBias[0]);
  script += panel("wrong pixels of depth maps", "slope bias (texels)", overBias[1]);
  script += panel("wrong pixels of depth maps", "normal offset (texels)", overBias[2]);
  return script + "unset multiplot\n";
}

std::string shadowPage(const ShadowBench& bench, const std::string& plot) {
  std::string body = fmt::format(
      "<p>One lamp over a floor of 12 m, {} x {} pixels. <i>to none</i>: the time of a frame over that of "
      "the "
      "same scene without shadows, timed in turns; certified rays and the audit included. <i>wrong px</i>: "
      "pixels that see the light where it is hidden, or the other way round, against rays in double "
      "precision. "
      "Slope biases and normal offsets of depth maps are tuned for each scene: those with the fewest wrong "
      "pixels in a map of middling size. <i>pcss</i>: the lamp has a radius, and so have soft shadows.</p>\n",
      bench.size.width, bench.size.height);
  if (!plot.empty())
    body += plotOf(plot, "wrong pixels over time, the size of maps and their biases; soft shadows");
  body += tableOf(waysTable(bench));
  body += "<h2>Wrong pixels of depth maps</h2>\n" + tableOf(biasTable(bench));
  TextTable machine{.head = {"measured on", ""}, .rows = {}};
  for (const auto& [name, value] : bench.machine) machine.rows.push_back({name, value});
  return pageOf("luxo: shadows", body + tableOf(machine));
}

}  // namespace luxo
