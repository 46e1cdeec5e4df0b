// SPDX-License-Identifier: Apache-2.0
// luxo diff A B: how different are two pictures?
#include <CLI/CLI.hpp>

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/error.h"
#include "console.h"
#include "exit_code.h"
#include "image/compare.h"
#include "image/flip.h"
#include "image/format.h"
#include "option_values.h"
#include "output_files.h"
#include "verbs.h"

namespace luxo {
namespace {

struct DiffOptions {
  std::string a, b, heat;
  std::optional<std::string> max, mean;
  bool json = false;
};

std::optional<double> limit(const char* option, const std::optional<std::string>& text) {
  if (!text) return std::nullopt;
  const double value = parseNumber(option, *text);
  if (value < 0)
    throw Error(ErrorKind::Usage, fmt::format("{} '{}' is below 0", option, *text), "0 asks for equality");
  return value;
}

// An 8-bit file can only be judged by its codes; two float files by their light.
ComparisonSpace spaceOf(const DiffOptions& options) {
  const ImageFormat a = requireImageFormat(options.a);
  const ImageFormat b = requireImageFormat(options.b);
  return storesSrgb8(a) || storesSrgb8(b) ? ComparisonSpace::Srgb8 : ComparisonSpace::Linear;
}

const char* nameOf(ComparisonSpace space) { return space == ComparisonSpace::Srgb8 ? "srgb8" : "linear"; }

/// dB, of the light and of its codes, whatever `space` the rest is in.
struct Psnr {
  double linear, srgb;
};

std::string textOf(const Comparison& c, const Psnr& psnr, const std::optional<Flip>& seen,
                   ComparisonSpace space) {
  std::string text = fmt::format(
      "space {}\nmax {} at {},{}\nmean {}\nrmse {}\npsnr {} dB\npsnr linear {} dB, sRGB {} dB\n"
      "differing {} of {} pixels (8 bit)\nnan {} samples\n",
      nameOf(space), c.max, c.maxX, c.maxY, c.mean, c.rmse, c.psnr, psnr.linear, psnr.srgb,
      c.differingPixels8, c.pixels, c.nanSamples);
  if (seen)
    text += fmt::format("flip mean {:.6g} p99.9 {:.6g} max {:.6g}\n", seen->mean, seen->p999, seen->max);
  return text;
}

// JSON has no infinity: null, and `equal` and `nan_samples` tell which one it was.
std::string jsonOf(const Comparison& c, const Psnr& psnr, const std::optional<Flip>& seen,
                   ComparisonSpace space, const DiffOptions& options, const Image& image) {
  const auto finite = [](double value) {
    return std::isfinite(value) ? nlohmann::ordered_json(value) : nullptr;
  };
  nlohmann::ordered_json json = {{"a", options.a},
                                 {"b", options.b},
                                 {"size", {image.width(), image.height()}},
                                 {"channels", image.channels()},
                                 {"space", nameOf(space)},
                                 {"equal", c.max == 0},
                                 {"max", finite(c.max)},
                                 {"max_at", {c.maxX, c.maxY}},
                                 {"mean", finite(c.mean)},
                                 {"rmse", finite(c.rmse)},
                                 {"psnr", finite(c.psnr)},
                                 {"psnr_linear", finite(psnr.linear)},
                                 {"psnr_srgb", finite(psnr.srgb)},
                                 {"pixels", c.pixels},
                                 {"differing_pixels", c.differingPixels8},
                                 {"differing_part", double(c.differingPixels8) / double(c.pixels)},
                                 {"nan_samples", c.nanSamples}};
  if (seen) json["flip"] = {{"mean", seen->mean}, {"p99.9", seen->p999}, {"max", seen->max}};
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

void requireWithin(const char* name, double value, const std::optional<double>& most) {
  if (!most || value <= *most) return;
  throw Error(ErrorKind::Requirement, fmt::format("the {} difference {} is above {}", name, value, *most));
}

int diff(const DiffOptions& options) {
  if (options.a.empty() || options.b.empty())
    throw Error(ErrorKind::Usage, "two pictures are needed", "as in luxo diff a.png b.png");
  const auto most = limit("--max", options.max);
  const auto mostMean = limit("--mean", options.mean);
  const ComparisonSpace space = spaceOf(options);
  if (!options.heat.empty()) static_cast<void>(requireImageFormat(options.heat));
  const NamedFile heat{"-o", options.heat}, pictures[] = {{"A", options.a}, {"B", options.b}};
  requireOutputs({&heat, 1}, pictures);

  const Image a = loadImage(options.a);
  const Image b = loadImage(options.b);
  const Comparison result = compare(a, b, space);
  if (!options.heat.empty()) saveImage(heatMap(a, b, space), options.heat);
  const Psnr psnr{compare(a, b, ComparisonSpace::Linear).psnr, compare(a, b, ComparisonSpace::Srgb).psnr};
  std::optional<Flip> seen;  // what has one channel is no picture to look at
  if (a.channels() >= 3) seen = flip(a, b);
  printData(options.json ? jsonOf(result, psnr, seen, space, options, a) : textOf(result, psnr, seen, space));
  requireWithin("largest", result.max, most);
  requireWithin("mean", result.mean, mostMean);
  return exit_code::kDone;
}

}  // namespace

void addDiff(CLI::App& app, Command& chosen) {
  const auto options = std::make_shared<DiffOptions>();
  CLI::App* verb = app.add_subcommand("diff", "how different two pictures are; exit code 6 above a limit");
  verb->group("Verbs");
  verb->add_option("A", options->a, "picture (png tga exr pfm)")->type_name("");
  verb->add_option("B", options->b, "picture of the same size")->type_name("");
  verb->add_option("--max", options->max, "largest difference of a sample allowed, such as 1/255")
      ->type_name("X");
  verb->add_option("--mean", options->mean, "mean difference allowed")->type_name("X");
  verb->add_flag("--json", options->json, "print the numbers as JSON");
  verb->add_option("-o,--output", options->heat, "write a map of the differences")->type_name("HEAT.png");
  verb->footer(
      "Samples are compared as 8-bit codes / 255 when a picture is png or tga, else as linear light. FLIP is "
      "the difference a person sees, 0 to 1, at 67 pixels per degree.");
  verb->callback([options, &chosen] { chosen = [options] { return diff(*options); }; });
}

}  // namespace luxo
