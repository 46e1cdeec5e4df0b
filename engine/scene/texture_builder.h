// SPDX-License-Identifier: Apache-2.0
// Builds the textures of a scene file: reads their images, or makes them.
#pragma once

#include <vector>

#include "base/diagnostic.h"
#include "scene/moment_formulas.h"
#include "scene/scene_file.h"
#include "scene/scene_problems.h"
#include "scene/texture_map.h"

namespace luxo {

inline constexpr int kMaxCheckerSquares = 512;

class TextureBuilder {
 public:
  /// `warnings` may be null.
  TextureBuilder(MomentFormulas& formulas, SceneProblems& problems, std::vector<Diagnostic>* warnings)
      : formulas_(formulas), problems_(problems), warnings_(warnings) {}

  /// A map of it as it lies. Without a texture where something is wrong, which is then among the problems,
  /// and where its file does not exist, which is a warning.
  [[nodiscard]] TextureMap build(const TextureDesc& desc);

 private:
  [[nodiscard]] std::shared_ptr<const Texture> imageOf(const TextureDesc& desc);
  [[nodiscard]] std::shared_ptr<const Texture> checker(const TextureDesc& desc);
  [[nodiscard]] Vec3 colorOf(const Quantity3& color);

  MomentFormulas& formulas_;
  SceneProblems& problems_;
  std::vector<Diagnostic>* warnings_;
};

}  // namespace luxo
