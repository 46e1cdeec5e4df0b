// SPDX-License-Identifier: Apache-2.0
#include "options.h"

#include <CLI/CLI.hpp>

#include <fmt/format.h>

#include "base/error.h"
#include "image/format.h"

namespace luxo {

/// The options as typed.
struct RenderOptions::Texts {
  SceneArgument sceneArgument;
  std::string scene, output;
  std::optional<std::string> size, time, frames, fps, samples, tolerance, shading, engine, camera, aov, skip,
      composition, audit, sample, requireError, sweep, report;
  std::vector<std::string> parameters;
  std::string device = "auto";
  bool hiddenLines = false, validate = false, list = false, allowOutside = false, quiet = false,
       verbose = false;
};

RenderOptions::RenderOptions(CLI::App& command, SceneArgument scene, RenderTarget destination)
    : texts_(std::make_unique<Texts>()) {
  Texts& t = *texts_;
  t.sceneArgument = scene;
  if (scene == SceneArgument::Taken)
    command
        .add_option("SCENE", t.scene,
                    "scene file, model, shader of a material, built-in name, or - for standard input")
        ->type_name("");
  const auto add = [&](const char* name, auto& value, const char* help, const char* type) {
    return command.add_option(name, value, help)->type_name(type);
  };
  const bool files = destination == RenderTarget::File;
  if (files)
    add("-o,--output", t.output,
        "picture to write: .png .tga (8 bit, sRGB), .exr .pfm (float, linear); ####, %04d or "
        "{frame:04} is the frame's number",
        "FILE");
  add("--size", t.size, "size in pixels (1280x720)", "WxH");
  add("--time", t.time, "moment to draw, in seconds (the scene's own)", "S");
  if (files) add("--frames", t.frames, "frames to draw: 1-250:2,300; frame n is at (n-1)/fps", "LIST");
  add("--fps", t.fps, "frames per second (24)", "N");
  add("--samples", t.samples, "samples per pixel, 1 to 256 (1)", "N");
  add("--tolerance", t.tolerance,
      "how far meshes may be from their surfaces, in pixels (0.5); exact shading shows none", "PX");
  add("--shading", t.shading,
      "exact flat gouraud phong toon wireframe, or a view: normal uv depth id residual (exact)", "NAME");
  add("--composition", t.composition,
      "how points get their light: fused (each fragment), deferred (each pixel once), or auto (auto)",
      "NAME");
  command.add_flag("--hidden-lines", t.hiddenLines, "wireframe: lines behind surfaces show, too");
  add("--engine", t.engine,
      files ? "vulkan, or reference: the ground truth by rays, needs no device (vulkan)" : "vulkan", "NAME");
  add("--camera", t.camera, "camera of the scene", "NAME");
  add("-P,--param", t.parameters, "value or expression of a scene parameter", "NAME=VALUE")
      ->allow_extra_args(false);
  if (files) {
    add("--sweep", t.sweep, "one picture for each value of a parameter, numbered like frames",
        "NAME=FROM:TO:STEP");
    add("--aov", t.aov,
        "what to write: color depth position normal uv id residual light-depth (of the first light with a "
        "shadow, light-depth:NODE of that node's) certificate (1 by a search, 2 by a ray, 3 not proven) "
        "(color)",
        "NAME");
    add("--sample", t.sample, "the sample of each pixel that --aov is of, from 0 (the pixel's centre)", "I");
    add("--report", t.report, "times, counts and errors of each frame, as JSON; - is stdout", "FILE");
  }
  add("--skip", t.skip,
      "what may be left out: all, none, or frustum,small,backface,lights,unchanged,passes,hidden (all)",
      "LIST");
  if (files)
    add("--audit", t.audit,
        "pixels of exact shading that are cast by the reference and compared: all, none, or at least so many "
        "(one in 4096, at least 64)",
        "N");
  if (files)
    add("--require-error", t.requireError,
        "fail (exit code 6) unless every mesh and every pixel of exact shading is at most this far from its "
        "surface, and no pixel is lost",
        "PX");
  add("--device", t.device, "auto, cpu, gpu, a number or a part of the name", "DEVICE");
  command.add_flag("--validate", t.validate, "run Vulkan's validation; any message fails the run");
  if (files && scene == SceneArgument::Taken) command.add_flag("--list", t.list, "list the built-in scenes");
  command.add_flag("--allow-outside", t.allowOutside,
                   "images and models may be outside of the folder of the file that names them");
  command.add_flag("-q,--quiet", t.quiet, "errors only");
  command.add_flag("-v,--verbose", t.verbose, "more about what is done");
}

RenderOptions::~RenderOptions() = default;

bool RenderOptions::hasOutput() const { return !texts_->output.empty(); }

namespace {

[[noreturn]] void refuse(const std::string& message, const std::string& hint) {
  throw Error(ErrorKind::Usage, message, hint);
}

// Sets `target` from `text`, when that was given.
template <class Target, class Parse>
void take(Target& target, const std::optional<std::string>& text, const Parse& parse) {
  if (text) target = parse(*text);
}

void refuseForWindow(const char* option, const std::optional<std::string>& text) {
  if (text)
    refuse(fmt::format("{} means nothing in a window", option),
           "name the picture to write, as in -o lamp.png");
}

void requireDistinct(const std::vector<ParameterValue>& parameters, const std::optional<Sweep>& sweep) {
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const std::string& name = parameters[i].name;
    for (std::size_t j = 0; j < i; ++j)
      if (parameters[j].name == name) refuse(fmt::format("-P gives '{}' twice", name), "keep one of them");
    if (sweep && sweep->name == name)
      refuse(fmt::format("-P and --sweep both give '{}'", name), "keep one of them");
  }
}

void requireForEngine(const RenderRequest& request) {
  if (request.engine == Engine::Reference && request.device != "auto" && request.device != "cpu")
    refuse("--device and --engine reference contradict each other", "rays need no Vulkan device");
}

}  // namespace

RenderRequest RenderOptions::request(RenderTarget destination) const {
  const Texts& t = *texts_;
  RenderRequest request;
  request.listScenes = t.list;
  if (t.list) return request;
  request.verbosity = verbosityOf(t.quiet, t.verbose);
  request.allowOutside = t.allowOutside;
  if (t.time && t.frames)
    refuse("--time and --frames exclude each other", "frame n is at (n-1)/fps; see --fps");
  if (t.sweep && t.frames)
    refuse("--sweep and --frames exclude each other", "a sweep draws one moment; choose it by --time");

  take(request.size, t.size, parseSize);
  take(request.time, t.time, [](const std::string& text) { return parseNumber("--time", text); });
  take(request.frames, t.frames, parseFrames);
  take(request.fps, t.fps, parseFps);
  take(request.samples, t.samples, parseSamples);
  take(request.tolerancePx, t.tolerance,
       [](const std::string& text) { return parsePixels("--tolerance", text); });
  take(request.shading, t.shading, parseShading);
  request.hiddenLines = t.hiddenLines;
  take(request.engine, t.engine, parseEngine);
  request.camera = t.camera;
  for (const std::string& text : t.parameters) request.parameters.push_back(parseParameter(text));
  take(request.sweep, t.sweep, parseSweep);
  take(request.aov, t.aov, [&](const std::string& text) {
    const std::size_t colon = text.find(':');
    request.fromLight = text.substr(0, colon) == "light-depth";
    if (!request.fromLight) return parseAov(text);
    if (colon != std::string::npos) request.light = text.substr(colon + 1);
    return Output::Depth;
  });
  take(request.composition, t.composition, parseComposition);
  take(request.skips, t.skip, parseSkips);
  take(request.audit, t.audit, parseAudit);
  if (t.sample) request.sample = parseSample(*t.sample);
  take(request.requireErrorPx, t.requireError,
       [](const std::string& text) { return parsePixels("--require-error", text, kErrorRange); });
  if (t.report) request.report = *t.report;
  if (t.device.empty()) refuse("--device is empty", "auto, cpu, gpu, a number or a part of the name");
  request.device = t.device;
  request.validate = t.validate;
  requireDistinct(request.parameters, request.sweep);
  requireForEngine(request);
  request.scene = t.scene;
  if (destination == RenderTarget::Window) {
    if (request.engine != Engine::Vulkan) refuseForWindow("--engine reference", t.engine);
    refuseForWindow("--frames", t.frames);
    refuseForWindow("--sweep", t.sweep);
    refuseForWindow("--aov", t.aov);
    refuseForWindow("--audit", t.audit);
    refuseForWindow("--sample", t.sample);
    refuseForWindow("--report", t.report);
    refuseForWindow("--require-error", t.requireError);
    return request;
  }

  if (t.sceneArgument == SceneArgument::Taken && t.scene.empty())
    refuse("no scene is given",
           "as in luxo render luxo-grandpa -o lamp.png; --list names the built-in scenes");
  if (t.output.empty()) refuse("no output is given", "name the picture to write, as in -o lamp.png");
  request.output = t.output;
  static_cast<void>(requireImageFormat(request.output));
  return request;
}

}  // namespace luxo
