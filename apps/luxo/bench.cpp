// SPDX-License-Identifier: Apache-2.0
// luxo bench: what does it cost to be how wrong?
#include <CLI/CLI.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <span>

#include "base/error.h"
#include "bench_page.h"
#include "bench_plot.h"
#include "bench_reload.h"
#include "bench_report.h"
#include "bench_shadow_report.h"
#include "bench_shadows.h"
#include "console.h"
#include "exit_code.h"
#include "image/file.h"
#include "interruption.h"
#include "open_scene.h"
#include "options.h"
#include "output_files.h"
#include "progress_bar.h"
#include "scene_request.h"
#include "validation.h"
#include "verbs.h"

namespace luxo {
namespace {

constexpr const char* kStandard = "standard";
constexpr std::array<const char*, 8> kStandardScenes = {"sphere", "torus", "flag",       "luxo-grandpa",
                                                        "teapot", "klein", "thin-torus", "catalogue"};
constexpr const char* kShadows = "shadows";
constexpr const char* kReload = "reload";
constexpr PixelSize kStandardSize = {1024, 1024};

struct BenchOptions {
  std::unique_ptr<RenderOptions> scene;
  std::string folder;
  std::optional<std::string> runs;
  bool quick = false;
};

int parseRuns(const std::string& text) {
  const double runs = parseNumber("--runs", text);
  if (runs < 1 || runs > 10'000 || runs != std::floor(runs))
    throw Error(ErrorKind::Usage, fmt::format("--runs '{}': not a number of runs", text),
                "a whole number from 1 to 10000, as in --runs 15");
  return static_cast<int>(runs);
}

/// Before minutes of work: the folder is there, and can be written to; of what is written there results.json
/// alone may be a scene.
void makeFolder(const std::filesystem::path& folder, std::span<const NamedFile> inputs = {}) {
  if (folder == "-")
    throw Error(ErrorKind::Usage, "-o - : these are several files", "name a folder, as in -o results");
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (!std::filesystem::is_directory(folder))
    throw Error(ErrorKind::Write,
                fmt::format("cannot make the folder '{}': {}", folder.string(), failure.message()),
                "name a folder that can be made, as in -o results");
  const NamedFile results{"-o", folder / "results.json"};
  requireOutputs({&results, 1}, inputs);
}

/// Where the work stands, over all scenes.
class Progress {
 public:
  Progress(bool visible, std::size_t scenes) : bar_(visible), scenes_(static_cast<double>(scenes)) {}

  /// Of the scene with that index; whether the work goes on.
  bool operator()(std::size_t scene, double part) {
    bar_.show((static_cast<double>(scene) + part) / scenes_);
    return interruptingSignal() == 0;
  }

 private:
  ProgressBar bar_;
  double scenes_;
};

/// A scene and what the request makes of it.
struct Subject {
  std::string name;
  Snapshot snapshot;
};

/// The built-in scenes' own shadows are another subject (bench_shadows.h); the lamp's light is that of its
/// shade.
void leaveOutShadows(Snapshot& snapshot) {
  for (SnapshotLight& light : snapshot.lights)
    if (!light.shade) light.casters.clear();
}

std::vector<Subject> subjectsOf(RenderRequest request, std::vector<NamedFile>& inputs) {
  std::vector<std::string> names = {request.scene};
  if (request.scene == kStandard) names = {kStandardScenes.begin(), kStandardScenes.end()};
  if (!request.size) request.size = kStandardSize;
  const std::vector<BuiltinScene> builtin = builtinScenes();
  std::vector<Subject> subjects;
  for (const std::string& name : names) {
    Scene scene = openScene(
        name, {.parameters = request.parameters, .inputs = &inputs, .allowOutside = request.allowOutside});
    moveByDevice(scene, request.device);
    const RenderSettings settings = settingsOf(scene, request);
    subjects.push_back({name, takeSnapshot(scene, settings.time, settings.size, cameraOf(scene, request))});
    if (std::ranges::find(builtin, name, &BuiltinScene::name) != builtin.end())
      leaveOutShadows(subjects.back().snapshot);
  }
  return subjects;
}

/// Nothing when interrupted.
std::optional<BenchResult> measureAll(gpu::Context& context, const std::vector<Subject>& subjects,
                                      const BenchPlan& plan, bool showsProgress) {
  BenchResult result{.machine = fingerprintOf(context.deviceInfo()),
                     .size = subjects.front().snapshot.view.size,
                     .runs = plan.runs,
                     .scenes = {}};
  Progress progress(showsProgress, subjects.size());
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    std::optional<BenchScene> measured = measureScene(context, subjects[i].name, subjects[i].snapshot, plan,
                                                      [&](double part) { return progress(i, part); });
    if (!measured) return std::nullopt;
    result.scenes.push_back(std::move(*measured));
  }
  return result;
}

std::string titleOf(const BenchResult& result) {
  std::string device = "?";
  for (const auto& [name, value] : result.machine)
    if (name == "device") device = value;
  return fmt::format("luxo: time against error, {} x {}, {}", result.size.width, result.size.height, device);
}

/// Of all scenes together, then of each. Empty without gnuplot.
std::vector<std::string> plotsOf(const BenchResult& result) {
  const std::span<const BenchScene> scenes = result.scenes;
  std::vector<std::string> plots;
  const auto add = [&](std::span<const BenchScene> some, const std::string& title) {
    if (auto svg = runGnuplot(paretoScript(some, title))) plots.push_back(std::move(*svg));
  };
  add(scenes, titleOf(result));
  if (!plots.empty() && scenes.size() > 1)
    for (std::size_t i = 0; i < scenes.size(); ++i) add(scenes.subspan(i, 1), scenes[i].name);
  return plots;
}

void write(const std::filesystem::path& file, const std::string& text) {
  writeFileAtomically(file, std::as_bytes(std::span(text)));
}

/// The exit code: worth retrying where a plot is missing.
int missesPlot(const char* file) {
  printError(Error(ErrorKind::Retry,
                   fmt::format("there is no gnuplot: {} is missing, everything else is written", file),
                   "install it (Debian: gnuplot-nox) and run this again"));
  return exit_code::kRetry;
}

int writeFiles(const ShadowBench& bench, const std::filesystem::path& folder) {
  write(folder / "shadows.csv", shadowCsv(bench));
  write(folder / "shadow_biases.csv", biasCsv(bench));
  write(folder / "shadows.json", shadowJson(bench));
  write(folder / "shadows.md", shadowMarkdown(bench));
  const std::optional<std::string> svg = runGnuplot(shadowScript(bench));
  write(folder / "shadows.html", shadowPage(bench, svg.value_or("")));
  if (!svg) return missesPlot("shadows.svg");
  write(folder / "shadows.svg", *svg);
  return exit_code::kDone;
}

int writeFiles(const BenchResult& result, const std::filesystem::path& folder) {
  write(folder / "results.csv", benchCsv(result));
  write(folder / "results.json", benchJson(result));
  write(folder / "summary.md", benchMarkdown(result));
  const std::vector<std::string> plots = plotsOf(result);
  write(folder / "index.html", benchPage(result, plots));
  if (!plots.empty()) {
    write(folder / "pareto.svg", plots[0]);
    return exit_code::kDone;
  }
  return missesPlot("pareto.svg");
}

int runShadowBench(const BenchOptions& options, const RenderRequest& request) {
  ShadowPlan plan;
  if (options.quick)
    plan = {.size = {240, 180},
            .runs = 3,
            .truthPixels = 200,
            .points = {1, 4, 16},
            .mapSizes = {64, 256},
            .constantBiases = {0, kLessonBias},
            .texelBiases = {1, 3}};
  if (request.size) plan.size = *request.size;
  if (options.runs) plan.runs = parseRuns(*options.runs);
  if (!options.folder.empty()) makeFolder(options.folder);
  const auto log = std::make_shared<gpu::ValidationLog>();
  std::optional<ShadowBench> bench;
  {
    gpu::Context context({.device = request.device, .validation = request.validate, .validationLog = log});
    Progress progress(request.verbosity == Verbosity::Normal, 1);
    bench = benchShadows(context, plan, [&](double part) { return progress(0, part); });
  }
  if (!bench) return exit_code::kSignal + interruptingSignal();
  requireNoMessage(*log);
  const int code = options.folder.empty() ? exit_code::kDone : writeFiles(*bench, options.folder);
  printData(shadowText(*bench));
  return code;
}

int runReloadBench(const BenchOptions& options, const RenderRequest& request) {
  ReloadPlan plan;
  if (options.quick) plan.runs = 3;
  if (request.size) plan.size = *request.size;
  if (options.runs) plan.runs = parseRuns(*options.runs);
  if (!options.folder.empty()) makeFolder(options.folder);
  const auto log = std::make_shared<gpu::ValidationLog>();
  std::optional<ReloadBench> bench;
  {
    Progress progress(request.verbosity == Verbosity::Normal, 1);
    bench = benchReload({.device = request.device, .validation = request.validate, .validationLog = log},
                        plan, [&](double part) { return progress(0, part); });
  }
  if (!bench) return exit_code::kSignal + interruptingSignal();
  requireNoMessage(*log);
  if (!options.folder.empty())
    write(std::filesystem::path(options.folder) / "reload.json", reloadJson(*bench));
  printData(reloadText(*bench));
  return exit_code::kDone;
}

int runBench(const BenchOptions& options) {
  rememberInterruptions();
  const RenderRequest request = options.scene->request(RenderTarget::Window);
  if (request.scene.empty())
    throw Error(ErrorKind::Usage, "no scene is given",
                "as in luxo bench teapot -o results; or luxo bench standard -o results");
  if (request.scene == kShadows) return runShadowBench(options, request);
  if (request.scene == kReload) return runReloadBench(options, request);
  BenchPlan plan = options.quick ? quickPlan() : fullPlan();
  if (options.runs) {
    plan.runs = plan.leastRuns = parseRuns(*options.runs);
    plan.muchMs = std::numeric_limits<double>::infinity();
  }
  std::vector<NamedFile> inputs;
  const std::vector<Subject> subjects = subjectsOf(request, inputs);
  if (!options.folder.empty()) makeFolder(options.folder, inputs);

  const auto log = std::make_shared<gpu::ValidationLog>();
  std::optional<BenchResult> result;
  {
    gpu::Context context({.device = request.device, .validation = request.validate, .validationLog = log});
    result = measureAll(context, subjects, plan, request.verbosity == Verbosity::Normal);
  }
  if (!result) return exit_code::kSignal + interruptingSignal();
  requireNoMessage(*log);
  const int code = options.folder.empty() ? exit_code::kDone : writeFiles(*result, options.folder);
  printData(benchText(*result));
  return code;
}

}  // namespace

void addBench(CLI::App& app, Command& chosen) {
  CLI::App* verb = app.add_subcommand("bench", "time against error, in many ways to draw a scene");
  verb->group("Verbs");
  const auto options = std::make_shared<BenchOptions>();
  options->scene = std::make_unique<RenderOptions>(*verb, SceneArgument::Taken, RenderTarget::Window);
  // These are what is swept, or what there is no choice of.
  for (const char* swept : {"--engine", "--samples", "--fps", "--tolerance", "--shading", "--skip"})
    verb->remove_option(verb->get_option(swept));
  verb->get_option("SCENE")->description(
      "scene file, built-in name, `standard`: the standard set, `shadows`: what shadows cost, and "
      "what is wrong with them (shadows.html, .md, .csv, .json, .svg, shadow_biases.csv), or `reload`: from "
      "a shader that is saved to its picture (reload.json)");
  verb->get_option("--size")->description("size in pixels (1024x1024)");
  verb->add_option(
          "-o,--output", options->folder,
          "folder for results.csv, results.json, summary.md, pareto.svg (needs gnuplot) and index.html")
      ->type_name("DIR");
  verb->add_option("--runs", options->runs,
                   "how often each way is timed, in turns (15; slow ways less often)")
      ->type_name("N");
  verb->add_flag("--quick", options->quick, "a few ways, at most five runs");
  verb->footer(
      "Every way to draw - shading, tolerance, samples - is timed in turns with the others and held against "
      "the ground truth.");
  verb->callback([options, &chosen] { chosen = [options] { return runBench(*options); }; });
}

}  // namespace luxo
