// SPDX-License-Identifier: Apache-2.0
#include "verify_random.h"

#include <CLI/CLI.hpp>

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "base/error.h"
#include "console.h"
#include "exit_code.h"
#include "interruption.h"
#include "open_scene.h"
#include "option_values.h"
#include "random/run.h"
#include "validation.h"

namespace luxo {
namespace {

std::uint64_t wholeNumber(const std::string& option, const std::string& text, double least) {
  const double value = parseNumber(option, text);
  if (!(value >= least) || value != std::floor(value) || value > 1e15)
    throw Error(ErrorKind::Usage, fmt::format("{} '{}': not a whole number from {}", option, text, least),
                fmt::format("as in {} 60", option));
  return static_cast<std::uint64_t>(value);
}

void summarize(const random::RunTotals& t) {
  printNote(fmt::format(
      "{} scenes, {} pixels, {} of them covered, {} undecided by the reference\n"
      "{} wrong, {} of them silently, in {} scenes; {} unconverged, {} uncertified; {} scenes refused, "
      "{} not judged to the end\n"
      "{:.0f} s of CPU for pictures, {:.0f} s for the reference; {} pictures beyond twice the reference and "
      "2 s",
      t.scenes, t.pixels, t.hits, t.undecided, t.wrong, t.silentlyWrong, t.failedScenes, t.unconverged,
      t.uncertified, t.refusedScenes, t.slowScenes, t.pictureSeconds, t.referenceSeconds, t.costlyScenes));
}

}  // namespace

struct RandomOptions::Texts {
  std::string count, seed = "1", first = "0", kind, limit = "600", audit;
  std::vector<CLI::Option*> options;  ///< the first is --random
};

RandomOptions::RandomOptions(CLI::App& command) : texts_(std::make_unique<Texts>()) {
  const auto add = [&](const char* name, std::string& text, const char* what, const char* type) {
    texts_->options.push_back(command.add_option(name, text, what)->type_name(type));
  };
  add("--random", texts_->count, "so many random hard scenes, or SCENE from so many random cameras", "N");
  add("--seed", texts_->seed, "of the random scenes (1)", "S");
  add("--first", texts_->first, "index of the first random scene (0)", "I");
  add("--kind", texts_->kind, "only random scenes of this kind; crowd: of named surfaces in shadows", "NAME");
  add("--audit", texts_->audit, "of the pictures; none: what a proof gets wrong is found, not mended (usual)",
      "all|N|none");
  add("--limit", texts_->limit, "processor time for each, then it is called unjudged (600)", "S");
}

RandomOptions::~RandomOptions() = default;

bool RandomOptions::asked() const { return texts_->options.front()->count() > 0; }

void RandomOptions::requireUnused() const {
  for (const CLI::Option* option : texts_->options)
    if (option->count() > 0)
      throw Error(ErrorKind::Usage, fmt::format("{} is about random scenes", option->get_name()),
                  "as in luxo verify --random 60 --seed 1");
}

int RandomOptions::run(const RenderRequest& render, const std::string& findings) const {
  random::RunRequest request{.count = wholeNumber("--random", texts_->count, 1),
                             .seed = wholeNumber("--seed", texts_->seed, 0),
                             .first = wholeNumber("--first", texts_->first, 0),
                             .kind = texts_->kind,
                             .options = {.size = render.size, .samples = {}},
                             .skips = render.skips,
                             .limitSeconds = static_cast<double>(wholeNumber("--limit", texts_->limit, 1)),
                             .findings = findings,
                             .print = printData,
                             .goesOn = [] { return interruptingSignal() == 0; }};
  if (render.samples && *render.samples != 1 && *render.samples != 4)
    throw Error(ErrorKind::Usage, fmt::format("--samples '{}': random scenes have 1 or 4", *render.samples));
  request.options.samples = render.samples;
  if (!texts_->audit.empty()) request.audit = parseAudit(texts_->audit);
  std::optional<Scene> scene;
  if (!render.scene.empty()) {
    scene.emplace(
        openScene(render.scene, {.parameters = render.parameters, .allowOutside = render.allowOutside}));
    moveByDevice(*scene, render.device);
    request.scene = &*scene;
  }

  const auto log = std::make_shared<gpu::ValidationLog>();
  random::RunTotals totals;
  {
    gpu::Context context({.device = render.device, .validation = render.validate, .validationLog = log});
    Renderer renderer(context);
    totals = runRandom(renderer, request);
  }
  requireNoMessage(*log);
  if (render.verbosity != Verbosity::Quiet) summarize(totals);
  if (interruptingSignal() != 0) return exit_code::kSignal + interruptingSignal();
  return totals.silentlyWrong > 0 || totals.refusedScenes > 0 ? exit_code::kRequirement : exit_code::kDone;
}

}  // namespace luxo
