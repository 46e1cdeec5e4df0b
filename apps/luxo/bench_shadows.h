// SPDX-License-Identifier: Apache-2.0
// What shadows cost, and what is wrong with them: exact ones from maps of several sizes beside depth maps,
// flattened ones and none, and soft ones of more and more points. All of a scene are timed in turns, in one
// run.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench_statistics.h"
#include "fingerprint.h"
#include "gpu/context.h"
#include "scene/camera.h"

namespace luxo {

/// One way to have the shadows of a scene.
struct ShadowWay {
  enum class Kind { None, Exact, DepthMap, Planar, Soft };
  Kind kind = Kind::None;
  int gridSize = 64;  ///< of the light's map of casters (DrawOptions::shadowGridSize), or its depth map
  int points = 1;     ///< of the light, where it has a radius
  double bias = 0, slopeBias = 0;  ///< of a depth map
  int pcf = 1;
};

/// The bias of the lesson that teaches depth maps: 43.34 of a viewport with 1,000 to the metre.
inline constexpr double kLessonBias = 0.04334;

[[nodiscard]] std::string nameOf(const ShadowWay& way);

struct ShadowRow {
  std::string scene;
  ShadowWay way;
  int runs = 0;
  Typical frameMs;  ///< up to the picture on the device, certified rays and audit included
  std::uint64_t shadowPasses = 0, rayPx = 0;
  /// Pixels that see the light where it is hidden, or the other way round, against rays in double precision;
  /// nothing for soft shadows, and where there are none.
  std::optional<std::uint64_t> wrongPx;
  /// Of soft shadows: the root mean square of the difference from the reference with kTruthPoints points,
  /// scene-linear, over the pixels in which that was cast.
  std::optional<double> rms;
};

/// Of the light whose shadows soft ones are held against.
inline constexpr std::uint32_t kTruthPoints = 1024;

struct ShadowBench {
  Fingerprint machine;
  PixelSize size;
  std::vector<ShadowRow> rows;  ///< by scene
};

struct ShadowPlan {
  PixelSize size{480, 360};
  int runs = 9;
  double muchMs = 6000;              ///< a way that has taken so long is not timed again
  std::uint64_t truthPixels = 1500;  ///< in which soft shadows are held against the reference
  std::vector<int> points = {1, 4, 16, 64};
  std::vector<int> mapSizes = {256, 512, 1024, 2048, 4096};  ///< of depth maps
};

/// `goesOn` as for measureScene(): nothing once it says no. Throws what Renderer and castPicture throw. Cost:
/// minutes.
[[nodiscard]] std::optional<ShadowBench> benchShadows(gpu::Context& context, const ShadowPlan& plan,
                                                      const std::function<bool(double)>& goesOn);

[[nodiscard]] std::string shadowText(const ShadowBench& bench);
[[nodiscard]] std::string shadowCsv(const ShadowBench& bench);
[[nodiscard]] std::string shadowJson(const ShadowBench& bench);
/// For runGnuplot(): wrong pixels over time and over the size of maps, and the error of soft shadows over
/// their points.
[[nodiscard]] std::string shadowScript(const ShadowBench& bench);
/// One HTML page with all of that. `plot`: an SVG file; empty: no gnuplot.
[[nodiscard]] std::string shadowPage(const ShadowBench& bench, const std::string& plot);

}  // namespace luxo
