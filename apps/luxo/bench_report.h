// SPDX-License-Identifier: Apache-2.0
// What `luxo bench` found, as text, CSV and JSON with stable names.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench_measure.h"
#include "fingerprint.h"
#include "scene/camera.h"

namespace luxo {

struct BenchResult {
  Fingerprint machine;
  PixelSize size;
  int runs = 0;
  std::vector<BenchScene> scenes;
};

/// The errors, in pixels, of the time-to-error table.
inline constexpr std::array<double, 3> kTargetErrorsPx = {0.5, 0.01, 0.001};

/// What one shading reaches in one scene, with one sample.
struct BenchShading {
  Shading shading = Shading::Phong;
  /// Milliseconds of the fastest picture whose largest error is at most that; nothing when none is.
  std::array<std::optional<double>, kTargetErrorsPx.size()> msOfError;
  double leastErrorPx = 0;
  std::optional<double> errorPerTriangles, errorPerMs;  ///< exponents of the fits
};

struct BenchSummary {
  std::vector<BenchShading> shadings;
  /// Of the usual hull over the usual mesh: time of a frame.
  std::optional<double> exactOverMesh;
};

[[nodiscard]] BenchSummary summaryOf(const BenchScene& scene);

/// The time-to-error table, for people.
[[nodiscard]] std::string benchText(const BenchResult& result);

/// A row per scene and way; what does not apply or is not finite is an empty field. RFC 4180 but for the line
/// ends.
[[nodiscard]] std::string benchCsv(const BenchResult& result);

/// The same numbers, the machine, and each scene's summary. What does not apply or is not finite is null.
[[nodiscard]] std::string benchJson(const BenchResult& result);

/// The columns of the CSV and the fields of a JSON row, in order: names, and units where they have one.
[[nodiscard]] std::vector<std::string_view> benchColumns();

}  // namespace luxo
