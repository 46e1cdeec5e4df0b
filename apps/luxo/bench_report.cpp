// SPDX-License-Identifier: Apache-2.0
#include "bench_report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace luxo {
namespace {

using Json = nlohmann::ordered_json;

struct Column {
  std::string_view name;
  double (*value)(const BenchRow&);
};

double real(std::uint64_t count) { return static_cast<double>(count); }

/// After `scene` and `shading`.
constexpr Column kColumns[] = {
    {"tolerance_px", [](const BenchRow& r) { return r.way.tolerancePx; }},
    {"samples", [](const BenchRow& r) { return static_cast<double>(r.way.samples); }},
    {"deferred", [](const BenchRow& r) { return r.way.deferred ? 1. : 0.; }},
    {"runs", [](const BenchRow& r) { return static_cast<double>(r.cost.runs); }},
    {"triangles", [](const BenchRow& r) { return real(r.cost.triangles); }},
    {"frame_ms", [](const BenchRow& r) { return r.cost.frameMs.median; }},
    {"frame_ms_p10", [](const BenchRow& r) { return r.cost.frameMs.p10; }},
    {"frame_ms_p90", [](const BenchRow& r) { return r.cost.frameMs.p90; }},
    {"device_ms", [](const BenchRow& r) { return r.cost.deviceMs.median; }},
    {"readback_ms", [](const BenchRow& r) { return r.cost.readbackMs; }},
    {"cold_ms", [](const BenchRow& r) { return r.cost.coldMs; }},
    {"judged_px", [](const BenchRow& r) { return real(r.error.judged); }},
    {"covered_px", [](const BenchRow& r) { return real(r.error.covered); }},
    {"bound_px", [](const BenchRow& r) { return r.error.boundPx; }},
    {"residual_max_px", [](const BenchRow& r) { return r.error.residualPx; }},
    {"unconverged_px", [](const BenchRow& r) { return r.error.unconvergedPx; }},
    {"uncertified_px", [](const BenchRow& r) { return r.error.uncertifiedPx; }},
    {"error_max_px", [](const BenchRow& r) { return r.error.largestPx(); }},
    {"position_max_px", [](const BenchRow& r) { return r.error.positionMaxPx; }},
    {"position_p99.9_px", [](const BenchRow& r) { return r.error.positionP999Px; }},
    {"silhouette_max_px", [](const BenchRow& r) { return r.error.silhouettePx; }},
    {"mismatches", [](const BenchRow& r) { return real(r.error.mismatches); }},
    {"mismatches_beyond_0.01_px", [](const BenchRow& r) { return real(r.error.beyond); }},
    {"normal_max_deg", [](const BenchRow& r) { return r.error.normalMaxDeg; }},
    {"normal_p99.9_deg", [](const BenchRow& r) { return r.error.normalP999Deg; }},
    {"differing_8bit_part", [](const BenchRow& r) { return r.error.differing8Part; }},
    {"psnr_db", [](const BenchRow& r) { return r.error.psnr; }},
};

/// Seven digits are more than any of these has, and whole numbers stay whole.
std::string textOf(double value) {
  if (!std::isfinite(value)) return "";
  return value == std::floor(value) && std::abs(value) < 1e15 ? fmt::format("{:.0f}", value)
                                                              : fmt::format("{:.6g}", value);
}

Json jsonOf(double value) {
  if (!std::isfinite(value)) return nullptr;
  return value == std::floor(value) && std::abs(value) < 1e15 ? Json(static_cast<std::int64_t>(value))
                                                              : Json(value);
}
Json jsonOf(const std::optional<double>& value) { return value ? jsonOf(*value) : Json(); }

Json jsonOf(const BenchRow& row) {
  Json json = {{"shading", nameOf(row.way.shading)}};
  for (const Column& column : kColumns) json[std::string(column.name)] = jsonOf(column.value(row));
  return json;
}

Json jsonOf(const BenchSummary& summary) {
  Json shadings = Json::array();
  for (const BenchShading& s : summary.shadings) {
    Json times = Json::object();
    for (std::size_t i = 0; i < kTargetErrorsPx.size(); ++i)
      times[fmt::format("{}", kTargetErrorsPx[i])] = jsonOf(s.msOfError[i]);
    shadings.push_back({{"shading", nameOf(s.shading)},
                        {"ms_of_error_px", std::move(times)},
                        {"least_error_px", jsonOf(s.leastErrorPx)},
                        {"slope_p99.9_triangles", jsonOf(s.errorPerTriangles)},
                        {"slope_p99.9_ms", jsonOf(s.errorPerMs)}});
  }
  Json json = {{"shadings", std::move(shadings)}, {"exact_over_mesh_time", nullptr}};
  if (summary.usual) json["exact_over_mesh_time"] = jsonOf(summary.usual->timeRatio());
  return json;
}

}  // namespace

std::vector<std::string_view> benchColumns() {
  std::vector<std::string_view> names = {"scene", "shading"};
  for (const Column& column : kColumns) names.push_back(column.name);
  return names;
}

std::string benchCsv(const BenchResult& result) {
  const auto quoted = [](const std::string& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string escaped;
    for (const char c : text) escaped.append(c == '"' ? 2 : 1, c);
    return fmt::format("\"{}\"", escaped);
  };
  std::string csv = fmt::format("{}\n", fmt::join(benchColumns(), ","));
  for (const BenchScene& scene : result.scenes)
    for (const BenchRow& row : scene.rows) {
      csv += fmt::format("{},{}", quoted(scene.name), nameOf(row.way.shading));
      for (const Column& column : kColumns) csv += fmt::format(",{}", textOf(column.value(row)));
      csv += '\n';
    }
  return csv;
}

std::string benchJson(const BenchResult& result) {
  Json machine = Json::object(), scenes = Json::array();
  for (const auto& [name, value] : result.machine) machine[name] = value;
  for (const BenchScene& scene : result.scenes) {
    Json rows = Json::array();
    for (const BenchRow& row : scene.rows) rows.push_back(jsonOf(row));
    scenes.push_back(
        {{"scene", scene.name},
         {"truth", {{"covered_px", scene.covered}, {"undecided_px", scene.undecided}, {"ms", scene.truthMs}}},
         {"summary", jsonOf(summaryOf(scene))},
         {"rows", std::move(rows)}});
  }
  const Json json = {{"luxo", LUXO_VERSION},          {"bench", 1},
                     {"machine", std::move(machine)}, {"size", {result.size.width, result.size.height}},
                     {"runs", result.runs},           {"scenes", std::move(scenes)}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace luxo
