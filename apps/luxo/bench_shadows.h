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
  /// Of a depth map, as in scene/light.h.
  double bias = 0, slopeBias = 0, normalOffset = 0;
  bool receiverPlane = false;
  int pcf = 1;
  bool hasRadius = false;  ///< a depth map's light, whose penumbrae are estimated (PCSS)
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
  /// nothing where a light has a radius, and where there are no shadows.
  std::optional<std::uint64_t> wrongPx;
  /// Of lights with a radius: the root mean square of the difference from the reference with kTruthPoints
  /// points, scene-linear, over the pixels in which that was cast.
  std::optional<double> rms;
};

/// Of the light whose shadows soft ones are held against.
inline constexpr std::uint32_t kTruthPoints = 1024;

/// What keeps a depth map's surfaces from shadowing themselves, and takes shadows' edges with it.
enum class BiasKind { Constant, Slope, NormalOffset };
[[nodiscard]] const char* nameOf(BiasKind kind);

/// A depth map without pcf.
struct BiasRow {
  std::string scene;
  BiasKind kind = BiasKind::Constant;
  double amount = 0;  ///< metres, or texels
  int mapSize = 0;
  std::uint64_t wrongPx = 0;  ///< as ShadowRow's
};

struct ShadowBench {
  Fingerprint machine;
  PixelSize size;
  std::vector<ShadowRow> rows;  ///< by scene
  std::vector<BiasRow> biases;  ///< by scene, kind and amount; map sizes ascend
};

struct ShadowPlan {
  PixelSize size{480, 360};
  int runs = 9;
  double muchMs = 6000;              ///< a way that has taken so long is not timed again
  std::uint64_t truthPixels = 1500;  ///< in which soft shadows are held against the reference
  std::vector<int> points = {1, 4, 16, 64};
  std::vector<int> mapSizes = {256, 512, 1024, 2048, 4096};                            ///< of depth maps
  std::vector<double> constantBiases = {0, 0.003, 0.01, 0.02, kLessonBias, 0.1, 0.3};  ///< metres
  std::vector<double> texelBiases = {0.5, 0.75, 1, 1.5, 2, 3, 5};  ///< of slope biases and normal offsets
};

/// `goesOn` as for measureScene(): nothing once it says no. Throws what Renderer and castPicture throw. Cost:
/// minutes.
[[nodiscard]] std::optional<ShadowBench> benchShadows(gpu::Context& context, const ShadowPlan& plan,
                                                      const std::function<bool(double)>& goesOn);

}  // namespace luxo
