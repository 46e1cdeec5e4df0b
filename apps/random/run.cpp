// SPDX-License-Identifier: Apache-2.0
#include "random/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/suggestion.h"
#include "image/file.h"
#include "random/crowd_scene.h"
#include "random/shrink.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"

namespace luxo::random {
namespace {

constexpr std::size_t kPlacesTold = 8;  // of wrong pixels, in a line: enough to look at

void requireKind(const std::string& kind) {
  const auto kinds = surfaceKinds();
  if (kind.empty() || kind == kCrowd ||
      std::ranges::any_of(kinds, [&](const SurfaceKind& k) { return k.name == kind; }))
    return;
  std::vector<std::string> names;
  for (const SurfaceKind& k : kinds) names.emplace_back(k.name);
  names.emplace_back(kCrowd);
  throw Error(ErrorKind::Usage, fmt::format("there is no kind of scene '{}'", kind),
              didYouMean(kind, names, fmt::format("the kinds are {}", listed(names))));
}

TrialOptions trialOptions(const RunRequest& request, int samples) {
  const double end = processorSeconds() + request.limitSeconds;
  return {.samples = samples, .skips = request.skips, .audit = request.audit, .goesOn = [&request, end] {
            return processorSeconds() < end && request.goesOn();
          }};
}

Trial tryJson(Renderer& renderer, const RunRequest& request, const Json& json) {
  const Scene scene = sceneOf(json);
  const RenderSettings& settings = scene.settings();
  return tryScene(renderer, takeSnapshot(scene, settings.time, settings.size),
                  trialOptions(request, settings.samples));
}

Json lineOf(const RunRequest& request, std::uint64_t index, const std::string& kind,
            const std::string& camera) {
  return {{"seed", request.seed}, {"index", index}, {"kind", kind}, {"camera", camera}};
}

void describe(Json& line, const Trial& trial) {
  line["size"] = {trial.size.width, trial.size.height};
  line["samples"] = trial.samples;
  line["pixels"] = trial.pixels;
  line["hits"] = trial.hits;
  line["wrong"] = {{"hit_miss", trial.wrong.hitMiss},
                   {"layer", trial.wrong.layer},
                   {"point", trial.wrong.point},
                   {"light", trial.wrong.light},
                   {"color", trial.wrongColors}};
  const std::span<const std::uint32_t> wrong = trial.wrong.pixels;
  for (const std::uint32_t pixel : wrong.first(std::min(wrong.size(), kPlacesTold)))
    line["wrong_at"].push_back({pixel % trial.size.width, pixel / trial.size.width});
  line["worst_px"] = rounded(trial.worstPx, 3);
  line["undecided"] = trial.undecided;
  line["silently_wrong"] = trial.silentlyWrong;
  line["unconverged"] = trial.unconverged;
  line["uncertified"] = trial.uncertified;
  line["resolved_by_rays"] = trial.resolvedByRays;
  line["audit_failed"] = trial.auditFailed;
  line["cpu_s"] = {{"picture", rounded(trial.pictureSeconds, 3)},
                   {"draw", rounded(trial.drawSeconds, 3)},
                   {"cast", rounded(trial.castSeconds, 3)},
                   {"reference", rounded(trial.referenceSeconds, 3)}};
}

void tellUnjudged(Json& line, const Trial& trial, const RunRequest& request) {
  if (!trial.complete) line["unjudged"] = fmt::format("stopped after {} s of CPU", request.limitSeconds);
}

void add(RunTotals& totals, const Trial& trial) {
  ++totals.scenes;
  totals.slowScenes += trial.complete ? 0 : 1;
  totals.costlyScenes += trial.complete && trial.costly() ? 1 : 0;
  totals.failedScenes += trial.silentlyWrong > 0 ? 1 : 0;
  totals.pixels += trial.pixels;
  totals.hits += trial.hits;
  totals.undecided += trial.undecided;
  totals.unconverged += trial.unconverged;
  totals.uncertified += trial.uncertified;
  totals.wrong += trial.wrong.total() + trial.wrongColors;
  totals.silentlyWrong += trial.silentlyWrong;
  totals.pictureSeconds += trial.pictureSeconds;
  totals.referenceSeconds += trial.referenceSeconds;
}

void write(const RunRequest& request, std::uint64_t index, const Json& scene) {
  std::error_code failed;
  std::filesystem::create_directories(request.findings, failed);
  const auto file = request.findings / fmt::format("random-{}-{}.luxo.json", request.seed, index);
  const std::string text = scene.dump(1) + "\n";
  writeFileAtomically(file, std::as_bytes(std::span(text)));
}

Json shrunkScene(Renderer& renderer, const RunRequest& request, const Json& scene, const Trial& trial) {
  const Failure failure = [&](const Json& candidate) -> std::optional<Trial> {
    try {
      Trial found = tryJson(renderer, request, candidate);
      return found.silentlyWrong > 0 ? std::optional(std::move(found)) : std::nullopt;
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::Scene) throw;
      return std::nullopt;
    }
  };
  return shrunk(scene, trial, failure);
}

}  // namespace

RunTotals runRandom(Renderer& renderer, const RunRequest& request) {
  requireKind(request.kind);
  RunTotals totals;
  for (std::uint64_t index = request.first, done = 0; done < request.count && request.goesOn(); ++index) {
    const bool crowd = request.kind == kCrowd;
    if (request.scene == nullptr && !request.kind.empty() && !crowd && kindAt(index) != request.kind)
      continue;
    ++done;
    Json line;
    try {
      Trial trial;
      if (request.scene != nullptr) {
        const RandomSight sight = randomSight(*request.scene, request.seed, index, request.options);
        line = lineOf(request, index, "scene", sight.camera);
        line["time"] = sight.time;
        line["view"] = sight.json;
        Snapshot snapshot = takeSnapshot(*request.scene, sight.time, sight.size, cameraOf(sight.json));
        // Drawings (toon, wireframe) have no truth, but their surfaces do.
        for (Material& material : snapshot.materials) material.shading.reset();
        // Nor has what a picture itself tells of openness; the light beside it has.
        snapshot.ambientOcclusion = {};
        trial = tryScene(renderer, snapshot, trialOptions(request, sight.samples));
        describe(line, trial);
        tellUnjudged(line, trial, request);
      } else {
        const HardScene hard = (crowd ? crowdScene : hardScene)(request.seed, index, request.options);
        line = lineOf(request, index, hard.kind, hard.camera);
        trial = tryJson(renderer, request, hard.json);
        describe(line, trial);
        tellUnjudged(line, trial, request);
        if (!request.findings.empty() && request.goesOn()) {
          if (trial.silentlyWrong > 0) {
            request.print(line.dump() + "\n");
            line = Json();
            write(request, index, shrunkScene(renderer, request, hard.json, trial));
          } else if (!trial.complete) {
            write(request, index, hard.json);
          }
        }
      }
      if (!request.goesOn()) break;
      add(totals, trial);
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::Scene) throw;
      if (line.empty()) line = lineOf(request, index, std::string(crowd ? kCrowd : kindAt(index)), "");
      line["error"] = error.what();
      ++totals.refusedScenes;
    }
    if (!line.empty()) request.print(line.dump() + "\n");
  }
  return totals;
}

Trial tryFile(Renderer& renderer, const std::filesystem::path& file, const Audit& audit) {
  const Scene scene = buildScene(readSceneFile(file));
  const RenderSettings& settings = scene.settings();
  return tryScene(renderer, takeSnapshot(scene, settings.time, settings.size),
                  {.samples = settings.samples, .audit = audit});
}

}  // namespace luxo::random
