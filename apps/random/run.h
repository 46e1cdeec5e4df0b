// SPDX-License-Identifier: Apache-2.0
// Many hard scenes, one after the other: behind `luxo verify --random`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "random/hard_scene.h"
#include "random/trial.h"

namespace luxo::random {

struct RunRequest {
  std::uint64_t count = 60, seed = 1, first = 0;
  std::string kind;  ///< only scenes of this kind count; empty: all
  HardSceneOptions options = {};
  Skips skips = {};
  Audit audit = {};
  /// Processor time for the pictures and the truth of a scene, seconds: after that it is not judged any
  /// further. Asked between pictures, and by the reference's rays.
  double limitSeconds = 600;
  std::filesystem::path findings;  ///< a folder for what fails, shrunk, or takes too long; empty: nowhere
  const Scene* scene = nullptr;    ///< this one from random cameras, instead of random scenes
  std::function<void(const std::string&)> print;       ///< takes a line of JSON, with its end
  std::function<bool()> goesOn = [] { return true; };  ///< asked now and then
};

struct RunTotals {
  std::uint64_t scenes = 0, failedScenes = 0, refusedScenes = 0;
  std::uint64_t slowScenes = 0;    ///< of `scenes`: not judged to the end, as they took limitSeconds
  std::uint64_t costlyScenes = 0;  ///< Trial::costly
  std::uint64_t pixels = 0, hits = 0, undecided = 0, unconverged = 0, uncertified = 0;
  std::uint64_t wrong = 0, silentlyWrong = 0;
  double pictureSeconds = 0, referenceSeconds = 0;
};

/// The line of a scene. Names: seed, index, kind, camera, size, samples, pixels, hits, wrong {hit_miss,
/// layer, point, light, color}, wrong_at (columns and rows of the first), worst_px,
/// undecided, silently_wrong, unconverged, uncertified, cpu_s {picture, draw,
/// reference, cast}: draw and cast are of the colours alone, the others with the judging; `unjudged`, why,
/// where that is of a part of the samples; `error` instead of all after camera where the renderer refused it.
///
/// Throws Error(Device) when the device is lost, Error(Write) when a finding cannot be written, Error(Usage)
/// for a kind that there is not.
[[nodiscard]] RunTotals runRandom(Renderer& renderer, const RunRequest& request);

/// What is wrong with a scene of a file: with the size and the samples that it asks for. Throws as
/// Renderer::render and Error(Scene).
[[nodiscard]] Trial tryFile(Renderer& renderer, const std::filesystem::path& file, const Audit& audit = {});

}  // namespace luxo::random
