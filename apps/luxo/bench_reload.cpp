// SPDX-License-Identifier: Apache-2.0
#include "bench_reload.h"
#include "base/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>

#include "base/assert.h"
#include "base/temporary_folder.h"
#include "draw/renderer.h"
#include "image/file.h"
#include "open_scene.h"
#include "scene/shader_files.h"
#include "scene/snapshot.h"
#include "scenes/gallery.h"
#include "shader_scene.h"

namespace luxo {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::string_view kMaterial = "vec4 material(Point p)";

/// Another shader each time, as large: its light times a number.
std::string editOf(std::string text, double factor) {
  const std::size_t at = text.find(kMaterial);
  LUXO_REQUIRE(at != std::string::npos);
  text.replace(at, kMaterial.size(), "vec4 unedited(Point p)");
  return text + fmt::format("{} {{ return vec4(vec3({:.6f}), 1.0) * unedited(p); }}\n", kMaterial, factor);
}

void save(const fs::path& file, const std::string& text) {
  writeFileAtomically(file, std::as_bytes(std::span(text)));
}

struct Times {
  std::vector<double> total, driver, own;
};

/// Saves the shader, and draws what it shows now.
void reload(Renderer& renderer, const fs::path& file, const std::string& text, PixelSize size, Times& times) {
  const Stopwatch watch;
  const double before = renderer.context().counters().pipelineMs;
  save(file, text);
  const OpenedShader opened = openShader(file.string(), {}, {.about = WarningsAbout::WhatIsLacking});
  const Snapshot snapshot = takeSnapshot(opened.scene, 0, size);
  DrawOptions options{.audit = {.extent = AuditExtent::None}};
  options.skips.unchanged = false;
  const double first = renderer.render(snapshot, options).statistics.ms.gpu;
  const double total = watch.milliseconds(), pipelines = renderer.context().counters().pipelineMs - before;
  const double again = renderer.render(snapshot, options).statistics.ms.gpu;
  const double driver = pipelines + std::max(first - again, 0.0);
  times.total.push_back(total);
  times.driver.push_back(driver);
  times.own.push_back(total - driver);
}

}  // namespace

std::vector<std::string> reloadShaders() {
  return {"gooch.frag", "steel.frag", "wood.frag", "ice.frag", "dent.frag"};
}

std::optional<ReloadBench> benchReload(const gpu::ContextDesc& desc, const ReloadPlan& plan,
                                       const std::function<bool(double)>& goesOn) {
  const TemporaryFolder folder;
  // Edits of a benchmark would drive out of the cache what people draw.
  setenv("LUXO_CACHE_DIR", (folder.path() / "cache").c_str(), 1);
  gpu::Context context(desc);
  ReloadBench bench{
      .machine = fingerprintOf(context.deviceInfo()), .size = plan.size, .runs = plan.runs, .rows = {}};
  Renderer renderer(context);
  const int all = static_cast<int>(plan.shaders.size()) * (plan.runs + 1);
  int done = 0;
  for (const std::string& shader : plan.shaders) {
    const MaterialShaderPtr ofGallery = galleryShaderFiles()->get(shader);
    for (const MaterialShader::File& file : ofGallery->files)
      save(folder.path() / fs::path(file.name).filename(), file.text);
    const std::string& text = ofGallery->files.front().text;
    Times times, warming;
    reload(renderer, folder.path() / "edited.frag", editOf(text, 0.5), plan.size,
           warming);  // the compiler's start
    for (int i = 0; i < plan.runs; ++i) {
      if (!goesOn(static_cast<double>(++done) / all)) return std::nullopt;
      reload(renderer, folder.path() / "edited.frag", editOf(text, 0.6 + 0.001 * i), plan.size, times);
    }
    ++done;
    bench.rows.push_back({.shader = shader,
                          .totalMs = typicalOf(times.total),
                          .driverMs = typicalOf(times.driver),
                          .ownMs = typicalOf(times.own),
                          .own = times.own});
  }
  return bench;
}

std::string reloadText(const ReloadBench& bench) {
  std::string text = fmt::format("{:<12} {:>10} {:>12} {:>16}   (ms, medians of {}; own: 80 % of them)\n",
                                 "shader", "in all", "the driver's", "luxo's own", bench.runs);
  for (const ReloadRow& row : bench.rows)
    text += fmt::format(
        "{:<12} {:>10.0f} {:>12.0f} {:>16}\n", row.shader, row.totalMs.median, row.driverMs.median,
        fmt::format("{:.0f} ({:.0f}..{:.0f})", row.ownMs.median, row.ownMs.p10, row.ownMs.p90));
  return text;
}

std::string reloadJson(const ReloadBench& bench) {
  Json machine = Json::object(), rows = Json::array();
  for (const auto& [name, value] : bench.machine) machine[name] = value;
  const auto json = [](const Typical& typical) {
    return Json{{"median", typical.median}, {"p10", typical.p10}, {"p90", typical.p90}};
  };
  for (const ReloadRow& row : bench.rows)
    rows.push_back({{"shader", row.shader},
                    {"total_ms", json(row.totalMs)},
                    {"driver_ms", json(row.driverMs)},
                    {"own_ms", json(row.ownMs)}});
  const Json all = {{"luxo", LUXO_VERSION},
                    {"bench_reload", 1},
                    {"machine", std::move(machine)},
                    {"size", {bench.size.width, bench.size.height}},
                    {"runs", bench.runs},
                    {"rows", std::move(rows)}};
  return all.dump(2) + "\n";
}

}  // namespace luxo
