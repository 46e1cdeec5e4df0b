// SPDX-License-Identifier: Apache-2.0
// Builds the materials of a scene file: their numbers, maps and shaders.
#pragma once

#include <memory>
#include <vector>

#include "base/diagnostic.h"
#include "scene/material.h"
#include "scene/moment_formulas.h"
#include "scene/named.h"
#include "scene/scene_file.h"
#include "scene/scene_problems.h"
#include "scene/shape_builder.h"

namespace luxo {

/// Whether nothing is seen through it, as it is written.
[[nodiscard]] bool isOpaque(const MaterialDesc& material);

class MaterialBuilder {
 public:
  /// `textures`: those of the file, by the time that build() is called. `warnings` may be null.
  MaterialBuilder(const SceneFile& file, const Named<TextureMap>& textures, MomentFormulas& formulas,
                  SceneProblems& problems, std::vector<Diagnostic>* warnings)
      : file_(file), textures_(textures), formulas_(formulas), problems_(problems), warnings_(warnings) {}

  /// With these colours and this opacity. What is wrong is among the problems.
  [[nodiscard]] Animated<Material> build(const MaterialDesc& desc, ShapeBuilder::MovingPaint paint);

  /// Whether its shader reads how its surface bends, so that it is another one on each.
  [[nodiscard]] bool readsCurvature(const MaterialDesc& desc) const;

 private:
  struct MapPlace;
  struct Moving;

  void addMaps(const MaterialDesc& desc, Moving& material);
  void addMap(const MapDesc& desc, TextureMap& map, MapPlace& place);
  void requireNumbers(const FileName& texture);
  void addShader(const MaterialDesc& desc, Moving& material);
  [[nodiscard]] std::shared_ptr<ShaderFiles> shaderFiles() const;
  void addLesson(const MaterialDesc& desc, Moving& material);

  const SceneFile& file_;
  const Named<TextureMap>& textures_;
  MomentFormulas& formulas_;
  SceneProblems& problems_;
  std::vector<Diagnostic>* warnings_;
};

}  // namespace luxo
