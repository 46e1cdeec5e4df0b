// SPDX-License-Identifier: Apache-2.0
// luxo gallery: every scene of the gallery on one sheet.
#include <CLI/CLI.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "console.h"
#include "draw/renderer.h"
#include "exit_code.h"
#include "image/format.h"
#include "interruption.h"
#include "open_scene.h"
#include "option_values.h"
#include "output_files.h"
#include "process_tuning.h"
#include "progress_bar.h"
#include "report.h"
#include "scene/ranges.h"
#include "scenes/gallery.h"
#include "validation.h"
#include "verbs.h"

namespace luxo {
namespace {

constexpr int kGapPx = 8;
constexpr float kPaper = 1;

/// The options as typed.
struct GalleryOptions {
  std::string output, size = "320x180", device = "auto";
  std::optional<std::string> columns, samples, report;
  bool validate = false, quiet = false, verbose = false;
};

/// Pictures of one size, row after row, with gaps between them.
struct Sheet {
  PixelSize cell;
  int columns, rows;

  [[nodiscard]] int left(int index) const { return index % columns * (cell.width + kGapPx); }
  [[nodiscard]] int top(int index) const { return index / columns * (cell.height + kGapPx); }
  [[nodiscard]] PixelSize size() const {
    return {columns * (cell.width + kGapPx) - kGapPx, rows * (cell.height + kGapPx) - kGapPx};
  }

  void place(const Image& picture, int index, Image& sheet) const {
    for (int y = 0; y < cell.height; ++y)
      std::ranges::copy(picture.row(y), sheet.pixel(left(index), top(index) + y).begin());
  }
};

Sheet sheetOf(const GalleryOptions& options, int count) {
  Sheet sheet{.cell = parseSize(options.size), .columns = 1, .rows = 1};
  if (options.columns)
    sheet.columns = parseColumns(*options.columns, count);
  else
    while (sheet.columns * sheet.columns < count) ++sheet.columns;
  sheet.rows = (count + sheet.columns - 1) / sheet.columns;
  if (const auto [width, height] = sheet.size(); std::max(width, height) > kMaxPictureSide)
    throw Error(ErrorKind::Usage,
                fmt::format("a sheet of {} pictures of {}x{} has {}x{} pixels", count, sheet.cell.width,
                            sheet.cell.height, width, height),
                fmt::format("at most {} on each side: choose a smaller --size", kMaxPictureSide));
  return sheet;
}

/// Draws them in turn with what the ones before have left: pictures do not depend on it. False when
/// interrupted.
bool drawAll(const GalleryOptions& options, const Sheet& sheet, Verbosity verbosity, gpu::Context& context,
             Image& picture, RunReport& report) {
  Renderer renderer(context);
  ProgressBar bar(verbosity == Verbosity::Normal);
  const auto scenes = galleryScenes();
  for (const EmbeddedScene& embedded : scenes) {
    const int index = static_cast<int>(report.frames.size());
    Scene scene = buildScene(galleryDescription(embedded));
    moveByDevice(scene, options.device);
    RenderSettings settings = scene.settings();
    settings.size = sheet.cell;
    if (options.samples) settings.samples = parseSamples(*options.samples);
    const auto goesOn = [&](double done) {
      bar.show((index + done) / static_cast<double>(scenes.size()));
      return interruptingSignal() == 0;
    };
    const std::optional<Picture> drawn =
        renderer.render(takeSnapshot(scene, settings.time, settings.size), drawOptions(settings), goesOn);
    if (!drawn || interruptingSignal() != 0) return false;
    sheet.place(drawn->image, index, picture);
    FrameReport& frame = report.frames.emplace_back();
    frame.frame = index + 1;
    frame.time = settings.time;
    frame.file = options.output;
    frame.statistics = drawn->statistics;
    frame.scene = embedded.name;
    frame.at = {sheet.left(index), sheet.top(index)};
    if (verbosity == Verbosity::Verbose)
      printNote(fmt::format("{}  {:.0f} ms", embedded.name, drawn->statistics.ms.total));
  }
  return true;
}

void requireOutputsOf(const GalleryOptions& options) {
  if (options.output.empty())
    throw Error(ErrorKind::Usage, "no output is given", "name the sheet to write, as in -o gallery.png");
  static_cast<void>(requireImageFormat(options.output));
  const std::string report = options.report.value_or("");
  requireOutputs(
      std::vector{NamedFile{"-o", options.output}, NamedFile{"--report", report == "-" ? "" : report}});
}

int runGallery(const GalleryOptions& options) {
  const Verbosity verbosity = verbosityOf(options.quiet, options.verbose);
  const int count = static_cast<int>(galleryScenes().size());
  const Sheet sheet = sheetOf(options, count);
  if (options.samples) static_cast<void>(parseSamples(*options.samples));
  requireOutputsOf(options);
  showLog(verbosity);
  rememberInterruptions();

  Image picture(sheet.size().width, sheet.size().height, 3);
  std::ranges::fill(picture.samples(), kPaper);
  RunReport report;
  report.scene = "gallery";
  report.size = sheet.size();
  const auto validation = std::make_shared<gpu::ValidationLog>();
  {
    gpu::Context context(
        {.device = options.device, .validation = options.validate, .validationLog = validation});
    const gpu::DeviceInfo& info = context.deviceInfo();
    report.device = {info.name, gpu::deviceTypeName(info.type), info.driver,
                     options.report ? std::optional(sinCosError(context)) : std::nullopt};
    report.startupMs = processMilliseconds();
    if (!drawAll(options, sheet, verbosity, context, picture, report))
      return exit_code::kSignal + interruptingSignal();
  }
  requireNoMessage(*validation);
  saveImage(picture, options.output);
  if (options.report) writeReport(report, *options.report);
  if (verbosity != Verbosity::Quiet)
    printNote(fmt::format("{}  {}x{}  {} scenes  {:.0f} ms  on {}", options.output, report.size.width,
                          report.size.height, count, processMilliseconds(), report.device.name));
  return exit_code::kDone;
}

}  // namespace

void addGallery(CLI::App& app, Command& chosen) {
  CLI::App* verb = app.add_subcommand("gallery", "draw every scene of the gallery on one sheet");
  verb->group("Verbs");
  const auto options = std::make_shared<GalleryOptions>();
  const auto add = [&](const char* name, auto& value, const char* help, const char* type) {
    verb->add_option(name, value, help)->type_name(type);
  };
  add("-o,--output", options->output, "sheet to write: .png .tga (8 bit, sRGB), .exr .pfm (float, linear)",
      "FILE");
  add("--size", options->size, "size of each picture in pixels (320x180)", "WxH");
  add("--columns", options->columns, "pictures in a row (as many as rows, or one more)", "N");
  add("--samples", options->samples, "samples per pixel, 1 to 256 (the scene's own)", "N");
  add("--report", options->report, "times, counts, errors and place of each picture, as JSON; - is stdout",
      "FILE");
  add("--device", options->device, "auto, cpu, gpu, a number or a part of the name", "DEVICE");
  verb->add_flag("--validate", options->validate, "run Vulkan's validation; any message fails the run");
  verb->add_flag("-q,--quiet", options->quiet, "errors only");
  verb->add_flag("-v,--verbose", options->verbose, "the time of each scene, and more");
  verb->footer(
      fmt::format("Row after row they are in the order of their names, as `luxo render --list` has them, {} "
                  "pixels apart. Each is\n"
                  "what `luxo render gallery/NAME --size WxH` draws.",
                  kGapPx));
  verb->callback([options, &chosen] { chosen = [options] { return runGallery(*options); }; });
}

}  // namespace luxo
