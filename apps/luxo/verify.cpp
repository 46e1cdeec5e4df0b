// SPDX-License-Identifier: Apache-2.0
// luxo verify: how far is a picture from the truth?
#include <CLI/CLI.hpp>

#include <fmt/format.h>

#include <cmath>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/stopwatch.h"
#include "console.h"
#include "exit_code.h"
#include "image/file.h"
#include "image/format.h"
#include "interruption.h"
#include "measured_picture.h"
#include "open_scene.h"
#include "option_values.h"
#include "options.h"
#include "output_files.h"
#include "progress_bar.h"
#include "scene_request.h"
#include "stability/stability.h"
#include "validation.h"
#include "verbs.h"
#include "verification_report.h"
#include "verify_random.h"

namespace luxo {
namespace {

struct VerifyOptions {
  const CLI::App* verb = nullptr;
  std::unique_ptr<RenderOptions> scene;
  std::unique_ptr<RandomOptions> random;
  std::optional<std::string> pixels, sample, requireError, report;
  std::string heat;
  bool json = false, strict = false;
  CLI::Option* stability = nullptr;  ///< whether it was given
  std::vector<std::string> cases;
};

/// What the options say beyond the scene's.
struct VerifyRequest {
  RenderRequest scene;
  std::optional<std::uint64_t> pixels;
  std::optional<double> mostErrorPx;
};

std::uint64_t parseCount(const std::string& text) {
  const double count = parseNumber("--pixels", text);
  if (count < 1 || count != std::floor(count) || count > 1e15)
    throw Error(ErrorKind::Usage, fmt::format("--pixels '{}': not a number of pixels", text),
                "a whole number above 0, as in --pixels 20000");
  return static_cast<std::uint64_t>(count);
}

VerifyRequest requestOf(const VerifyOptions& options) {
  VerifyRequest request{options.scene->request(RenderTarget::Window), std::nullopt, std::nullopt};
  if (options.pixels) request.pixels = parseCount(*options.pixels);
  if (options.sample) request.scene.sample = parseSample(*options.sample);
  if (options.requireError)
    request.mostErrorPx = parsePixels("--require-error", *options.requireError, kErrorRange);
  if (!options.heat.empty() && !options.random->asked()) static_cast<void>(requireImageFormat(options.heat));
  return request;
}

void requireGroundTruth(Shading shading) {
  if (showsData(shading) || shading == Shading::Wireframe)
    throw Error(ErrorKind::Scene, fmt::format("shading '{}' has no ground truth", nameOf(shading)),
                "give --shading exact, phong, flat, gouraud or toon");
}

/// Shadows that are approximations promise nothing that could be required.
void requireWithin(const Verification& v, double mostPx, bool approximateShadows) {
  const auto miss = [&](const std::string& what) {
    throw Error(ErrorKind::Requirement, fmt::format("{}, more than the {:.3g} px required", what, mostPx));
  };
  if (v.nanPixels > 0) miss(fmt::format("{} pixels are not numbers", v.nanPixels));
  if (v.coverage.farthestPx > mostPx)
    miss(fmt::format("a pixel is wrong that is {:.3g} px from the silhouette", v.coverage.farthestPx));
  if (v.positionPx.max > mostPx) miss(fmt::format("the position error is {:.3g} px", v.positionPx.max));
  if (v.wrong.color > 0)
    throw Error(ErrorKind::Requirement,
                fmt::format("{} pixels have a colour that is no shadow's and is off by more than 1/255",
                            v.wrong.color));
  if (v.wrong.light > 0 && !approximateShadows)
    throw Error(
        ErrorKind::Requirement,
        fmt::format("{} pixels see a light that is in shadow, or the other way round", v.wrong.light));
}

void requireOneSample(const RenderRequest& render) {
  if (render.scene.empty())
    throw Error(ErrorKind::Usage, "no scene is given",
                "as in luxo verify teapot; or luxo verify --stability");
  if (render.samples && !render.sample)
    throw Error(ErrorKind::Usage, "of a scene's samples one is judged at a time",
                fmt::format("say which, as in --samples {} --sample 0", *render.samples));
}

/// The picture that is judged. Adds to the report what drew it.
MeasuredFrame drawn(const Snapshot& snapshot, const RenderSettings& settings, const RenderRequest& render,
                    VerificationReport& report) {
  MeasuredFrame measured;
  const auto log = std::make_shared<gpu::ValidationLog>();
  {
    gpu::Context context({.device = render.device, .validation = render.validate, .validationLog = log});
    const gpu::DeviceInfo& info = context.deviceInfo();
    report.device = {info.name, gpu::deviceTypeName(info.type), info.driver};
    Renderer renderer(context);
    DrawOptions draw = drawOptions(settings);
    draw.skips = render.skips;
    draw.composition = render.composition;
    measured = measure(renderer, snapshot, draw);
  }
  requireNoMessage(*log);
  report.statistics = measured.statistics;
  return measured;
}

/// Incomplete where a signal has interrupted it.
ReferencePicture castTruth(const Snapshot& snapshot, const RenderSettings& settings, Verbosity verbosity,
                           const std::vector<std::uint32_t>& pixels) {
  ProgressBar bar(verbosity == Verbosity::Normal);
  return castPicture(snapshot, {.pixels = withNeighbours(settings.size, pixels),
                                .shading = settings.shading,
                                .progress = [&](double done) {
                                  bar.show(done);
                                  return interruptingSignal() == 0;
                                }});
}

int verifyScene(const VerifyOptions& options) {
  const VerifyRequest request = requestOf(options);
  const RenderRequest& render = request.scene;
  requireOneSample(render);
  const bool printsReport = options.report == "-";
  const NamedFile outputs[] = {{"-o", options.heat},
                               {"--report", printsReport ? "" : options.report.value_or("")}};
  std::vector<NamedFile> inputs;
  Scene scene = openScene(render.scene, {.parameters = render.parameters,
                                         .inputs = &inputs,
                                         .allowOutside = render.allowOutside,
                                         .showsProgress = render.verbosity == Verbosity::Normal});
  moveByDevice(scene, render.device);
  requireOutputs(outputs, inputs);
  const RenderSettings settings = settingsOf(scene, render);
  requireGroundTruth(settings.shading);
  Snapshot snapshot = takeSnapshot(scene, settings.time, settings.size, cameraOf(scene, render));
  if (const auto offset = sampleOffsetOf(settings, render)) snapshot.view = sampledAt(snapshot.view, *offset);

  VerificationReport report{.scene = render.scene,
                            .shading = std::string(nameOf(settings.shading)),
                            .device = {},
                            .size = settings.size,
                            .time = settings.time,
                            .statistics = {},
                            .verification = {}};
  report.approximateShadows = approximateShadows(snapshot);
  const MeasuredFrame measured = drawn(snapshot, settings, render, report);

  // Shadows are held against exact ones, whatever the scene asks for.
  const Snapshot exact = withExactShadows(snapshot);
  std::vector<std::uint32_t> pixels;  // none: all
  if (request.pixels && *request.pixels < measured.picture.id.samples().size())
    pixels = spreadPixels(settings.size, *request.pixels);
  const Stopwatch watch;
  const ReferencePicture truth = castTruth(exact, settings, render.verbosity, pixels);
  if (!truth.complete) return exit_code::kSignal + interruptingSignal();
  report.truthMs = watch.milliseconds();
  report.verification = verify(exact, truth, measured.picture,
                               {.shading = settings.shading,
                                .pixels = std::move(pixels),
                                .boundPx = report.statistics.error.boundPx,
                                .colors = report.approximateShadows == 0});

  if (!options.heat.empty()) saveImage(errorHeat(report.verification.positionMap), options.heat);
  const std::string json = verificationJson(report, scene, snapshot);
  if (options.report && !printsReport) writeFileAtomically(*options.report, std::as_bytes(std::span(json)));
  printData(options.json || printsReport ? json : verificationText(report, scene, snapshot));
  if (request.mostErrorPx)
    requireWithin(report.verification, *request.mostErrorPx, report.approximateShadows > 0);
  return exit_code::kDone;
}

int verifyStability(const VerifyOptions& options) {
  const RenderRequest request = requestOf(options).scene;
  if (!request.scene.empty())
    throw Error(ErrorKind::Usage, "--stability brings its own scenes", "leave the scene out");
  const auto log = std::make_shared<gpu::ValidationLog>();
  std::vector<std::string> cases = options.cases;
  std::erase(cases, "");  // CLI11's way to say that an option came without a value
  const bool passed = runStability({.ids = cases,
                                    .json = options.json,
                                    .strict = options.strict,
                                    .options = {.shading = request.shading.value_or(Shading::Exact),
                                                .device = request.device,
                                                .validate = request.validate,
                                                .validationLog = log},
                                    .print = printData});
  requireNoMessage(*log);
  return passed ? exit_code::kDone : exit_code::kRequirement;
}

void requireOneScene(const VerifyOptions& options, std::initializer_list<const char*> names,
                     const char* hint) {
  for (const char* name : names)
    if (options.verb->count(name) > 0)
      throw Error(ErrorKind::Usage, fmt::format("{} is about one scene", name), hint);
}

int runVerify(const VerifyOptions& options) {
  rememberInterruptions();
  if (options.random->asked()) {
    requireOneScene(
        options,
        {"--sample", "--report", "--pixels", "--require-error", "--shading", "--tolerance", "--time",
         "--camera", "--composition"},
        "random ones have cameras and moments of their own, and are judged in exact shading, every pixel and "
        "sample; what is found is printed");
    return options.random->run(requestOf(options).scene, options.heat);
  }
  options.random->requireUnused();
  if (options.stability->count() == 0) return verifyScene(options);
  requireOneScene(options,
                  {"--sample", "--samples", "--report", "--pixels", "--require-error", "--output", "--size",
                   "--time", "--tolerance", "--camera", "--param", "--composition", "--skip"},
                  "--stability brings its own scenes, with all of that; --json prints what is found as JSON");
  return verifyStability(options);
}

}  // namespace

void addVerify(CLI::App& app, Command& chosen) {
  CLI::App* verb = app.add_subcommand("verify", "how far a picture is from the truth, in every pixel");
  verb->group("Verbs");
  const auto options = std::make_shared<VerifyOptions>();
  options->verb = verb;
  options->scene = std::make_unique<RenderOptions>(*verb, SceneArgument::Taken, RenderTarget::Window);
  // One sample of each pixel is drawn, by Vulkan.
  for (const char* meaningless : {"--engine", "--fps", "--hidden-lines"})
    verb->remove_option(verb->get_option(meaningless));
  verb->get_option("--samples")
      ->description(
          "samples per pixel that --sample is one of (the scene's own); of random scenes 1 or 4 (some 1, "
          "some 4)");
  verb->add_option("--sample", options->sample,
                   "judge this sample of each pixel, from 0 (the pixels' centres, without it)")
      ->type_name("I");
  options->random = std::make_unique<RandomOptions>(*verb);
  verb->add_option("--pixels", options->pixels, "judge this many pixels, evenly spread (all)")
      ->type_name("N");
  verb->add_option(
          "--require-error", options->requireError,
          "fail (exit code 6) if a position is off by more, or a pixel wrong that is farther from the "
          "silhouette")
      ->type_name("PX");
  verb->add_flag("--json", options->json, "print the numbers as JSON");
  verb->add_option("--report", options->report, "write the JSON to a file as well; -: as --json")
      ->type_name("FILE");
  verb->add_option("-o,--output", options->heat,
                   "write a map of the position errors; with --random a folder for scenes that fail, shrunk")
      ->type_name("HEAT.png|DIR");
  options->stability =
      verb->add_option("--stability", options->cases, "run the stability suite, or these cases of it")
          ->type_name("[ST-nn ...]")
          ->expected(0, 40);
  verb->add_flag("--strict", options->strict, "with --stability: misses that are known fail, too");
  verb->footer(
      "The truth is cast by rays in double precision (render --engine reference). `float32` is what the "
      "truth "
      "itself misses by when its numbers are rounded as the picture's are.");
  verb->callback([options, &chosen] { chosen = [options] { return runVerify(*options); }; });
}

}  // namespace luxo
