// SPDX-License-Identifier: Apache-2.0
// What random scenes of tests have in common: numbers, a background, and who looks at what is around the
// origin.
#pragma once

#include <cstdint>
#include <random>

#include "scene/scene.h"

namespace luxo::test {

class RandomScene {
 protected:
  explicit RandomScene(std::uint32_t seed) : random_(seed) {}

  /// From 0 to 1; and in the cube from -1 to 1.
  double any() { return std::uniform_real_distribution<double>(0, 1)(random_); }
  Vec3 direction() { return {2 * any() - 1, 2 * any() - 1, 2 * any() - 1}; }
  /// Of a lamp, above all.
  Vec3 above() { return Vec3(5 * any() - 2.5, 2.5 + 2 * any(), 5 * any() - 2.5); }
  Camera camera() { return {.eye = Vec3(2, 1.2 + any(), 3) * (1 + 0.4 * any()), .lookAt = Vec3(0, -0.2, 0)}; }
  [[nodiscard]] static Scene emptyScene() {
    Scene scene;
    scene.set(RenderSettings{.background = Vec3(0.1, 0.15, 0.2)});
    return scene;
  }

  std::mt19937 random_;
};

}  // namespace luxo::test
