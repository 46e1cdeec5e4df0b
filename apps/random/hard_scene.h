// SPDX-License-Identifier: Apache-2.0
// Hard scenes, each a pure function of a seed and an index: text of a scene file, with a camera.
//
//     const HardScene hard = hardScene(1, 17, {});
//     const Scene scene = sceneOf(hard.json);
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "random/hard_camera.h"
#include "scene/scene.h"

namespace luxo::random {

/// What the caller decides instead of chance.
struct HardSceneOptions {
  std::optional<PixelSize> size = {};  ///< else 96x72 to 480x360, a quarter of these pixels with 4 samples
  std::optional<int> samples = {};     ///< 1 or 4
};

struct HardScene {
  std::string kind, camera;  ///< what it is, and how it is seen
  Json json;                 ///< a scene file; its `render` has size and samples
};

/// The kind of surface of an index: all kinds take turns, whatever the seed.
[[nodiscard]] std::string_view kindAt(std::uint64_t index);

/// Cost: milliseconds.
[[nodiscard]] HardScene hardScene(std::uint64_t seed, std::uint64_t index, const HardSceneOptions& options);

/// A scene of the caller's, once more, through a random camera at a random moment of its first ten seconds.
struct RandomSight {
  std::string camera;  ///< how it is seen
  Json json;           ///< the camera
  double time = 0;     ///< seconds
  PixelSize size;
  int samples = 1;
};
[[nodiscard]] RandomSight randomSight(const Scene& scene, std::uint64_t seed, std::uint64_t index,
                                      const HardSceneOptions& options);

/// The scene that a description means. Throws Error(Scene).
[[nodiscard]] Scene sceneOf(const Json& json);

}  // namespace luxo::random
