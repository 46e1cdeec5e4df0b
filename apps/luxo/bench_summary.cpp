// SPDX-License-Identifier: Apache-2.0
#include "bench_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace luxo {
namespace {

BenchShading summaryOf(const BenchScene& scene, Shading shading) {
  std::vector<CostAndError> largest, typical, triangles;
  BenchShading summary{.shading = shading,
                       .msOfError = {},
                       .leastErrorPx = std::numeric_limits<double>::infinity(),
                       .errorPerTriangles = {},
                       .errorPerMs = {}};
  for (const BenchRow& row : scene.rows) {
    if (row.way.shading != shading || row.way.samples != 1 || row.way.deferred) continue;
    const double ms = row.cost.frameMs.median;
    largest.push_back({ms, row.error.largestPx()});
    typical.push_back({ms, row.error.positionP999Px});
    triangles.push_back({static_cast<double>(row.cost.triangles), row.error.positionP999Px});
    summary.leastErrorPx = std::min(summary.leastErrorPx, row.error.largestPx());
  }
  for (std::size_t i = 0; i < kTargetErrorsPx.size(); ++i)
    summary.msOfError[i] = costOfError(largest, kTargetErrorsPx[i]);
  // A shell's size is not what its picture's error comes from.
  if (shading != Shading::Exact) {
    summary.errorPerTriangles = powerOf(triangles);
    summary.errorPerMs = powerOf(typical);
  }
  return summary;
}

/// A dash for what does not apply.
std::string number(double value, const char* format = "{:.2g}") {
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : "-";
}
std::string number(const std::optional<double>& value, const char* format) {
  return number(value.value_or(std::nan("")), format);
}

/// 1234567 as 1,234,567.
std::string grouped(std::uint64_t count) {
  const std::string digits = std::to_string(count);
  std::string text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) text += ',';
    text += digits[i];
  }
  return text;
}

}  // namespace

BenchSummary summaryOf(const BenchScene& scene) {
  BenchSummary summary;
  const BenchRow *exact = nullptr, *mesh = nullptr, *deferred = nullptr;
  for (const BenchRow& row : scene.rows) {
    const auto known = [&](const BenchShading& s) { return s.shading == row.way.shading; };
    if (std::none_of(summary.shadings.begin(), summary.shadings.end(), known))
      summary.shadings.push_back(summaryOf(scene, row.way.shading));
    if (isPictured(row.way)) (row.way.shading == Shading::Exact ? exact : mesh) = &row;
    if (row.way.deferred) deferred = &row;
  }
  if (exact != nullptr && mesh != nullptr) summary.usual = ExactAndMesh{*exact, *mesh};
  if (exact != nullptr && deferred != nullptr)
    summary.deferredRatio = deferred->cost.frameMs.median / exact->cost.frameMs.median;
  return summary;
}

TextTable usualTable(const BenchResult& result) {
  TextTable table{
      .head = {"scene", "mesh triangles", "mesh ms", "mesh error px", "mesh 8 bit", "exact triangles",
               "exact ms", "exact error px", "exact 8 bit", "time ratio", "deferred over fused"},
      .rows = {}};
  for (const BenchScene& scene : result.scenes) {
    const BenchSummary summary = summaryOf(scene);
    const auto& usual = summary.usual;
    if (!usual) continue;
    std::vector<std::string> cells = {scene.name};
    for (const BenchRow* row : {&usual->mesh, &usual->exact}) {
      cells.push_back(grouped(row->cost.triangles));
      cells.push_back(number(row->cost.frameMs.median, "{:.1f}"));
      cells.push_back(number(row->error.largestPx()));
      cells.push_back(number(row->error.differing8Part));
    }
    cells.push_back(number(usual->timeRatio(), "{:.2f}"));
    cells.push_back(number(summary.deferredRatio, "{:.2f}"));
    table.rows.push_back(std::move(cells));
  }
  return table;
}

TextTable timeToErrorTable(const BenchResult& result) {
  TextTable table{.head = {"scene", "shading"}, .rows = {}};
  for (const double error : kTargetErrorsPx) table.head.push_back(fmt::format("ms for {} px", error));
  for (const char* name : {"least error px", "error ~ triangles ^", "error ~ ms ^"})
    table.head.emplace_back(name);
  for (const BenchScene& scene : result.scenes)
    for (const BenchShading& s : summaryOf(scene).shadings) {
      std::vector<std::string> cells = {scene.name, std::string(nameOf(s.shading))};
      for (const auto& ms : s.msOfError) cells.push_back(number(ms, "{:.1f}"));
      cells.push_back(number(s.leastErrorPx));
      cells.push_back(number(s.errorPerTriangles, "{:.2f}"));
      cells.push_back(number(s.errorPerMs, "{:.2f}"));
      table.rows.push_back(std::move(cells));
    }
  return table;
}

std::string benchText(const BenchResult& result) {
  return inColumns(usualTable(result)) + '\n' + inColumns(timeToErrorTable(result));
}

std::string benchMarkdown(const BenchResult& result) {
  std::vector<std::string> machine;
  for (const auto& [name, value] : result.machine) machine.push_back(fmt::format("{} {}", name, value));
  return fmt::format("{}\n{}\n{} x {}, {}.\n", inMarkdown(usualTable(result)),
                     inMarkdown(timeToErrorTable(result)), result.size.width, result.size.height,
                     fmt::join(machine, "; "));
}

}  // namespace luxo
