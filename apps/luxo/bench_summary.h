// SPDX-License-Identifier: Apache-2.0
// What a benchmark comes to: the exact picture against the usual mesh, and what an error costs.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "bench_measure.h"
#include "fingerprint.h"
#include "scene/camera.h"
#include "text_table.h"

namespace luxo {

struct BenchResult {
  Fingerprint machine;
  PixelSize size;
  int runs = 0;  ///< of each way, at most
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
  /// Of meshes: exponents of the fits of the error that 99.9 % of the pixels do not exceed. (The largest
  /// error is that of a single pixel, and no law's.)
  std::optional<double> errorPerTriangles, errorPerMs;
};

/// The usual ways to draw a scene: a shell and a mesh of the usual tolerance, one sample.
struct ExactAndMesh {
  BenchRow exact, mesh;

  [[nodiscard]] double timeRatio() const { return exact.cost.frameMs.median / mesh.cost.frameMs.median; }
};

struct BenchSummary {
  std::vector<BenchShading> shadings;
  std::optional<ExactAndMesh> usual;  ///< when both were drawn
  /// Time of the exact picture whose points are found first and lit later, over the usual one's; NaN: one of
  /// them was not drawn.
  double deferredRatio = std::numeric_limits<double>::quiet_NaN();
};

[[nodiscard]] BenchSummary summaryOf(const BenchScene& scene);

/// The exact picture against the usual mesh: a row per scene that was drawn in both ways.
[[nodiscard]] TextTable usualTable(const BenchResult& result);

/// What an error costs: a row per scene and shading.
[[nodiscard]] TextTable timeToErrorTable(const BenchResult& result);

/// Both tables, in columns of a terminal.
[[nodiscard]] std::string benchText(const BenchResult& result);

/// Both tables and the machine in Markdown (GitHub's tables).
[[nodiscard]] std::string benchMarkdown(const BenchResult& result);

}  // namespace luxo
