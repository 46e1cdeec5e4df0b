// SPDX-License-Identifier: Apache-2.0
#include "export/carried_scene.h"

#include <algorithm>

#include "scene/scene_writer.h"

namespace luxo {

bool namesFiles(const SceneFile& file) {
  return std::ranges::any_of(
             file.surfaces,
             [](const SurfaceDesc& surface) { return std::holds_alternative<MeshShape>(surface.shape); }) ||
         std::ranges::any_of(file.textures,
                             [](const TextureDesc& texture) { return !texture.file.empty(); }) ||
         std::ranges::any_of(file.nodes, [](const NodeDesc& node) { return !node.model.empty(); }) ||
         std::ranges::any_of(file.materials,
                             [](const MaterialDesc& material) { return material.hasShader(); });
}

std::optional<std::string> carriedScene(SceneFile file, std::span<const ParameterOverride> overrides,
                                        std::optional<double> timeSeconds) {
  if (namesFiles(file)) return std::nullopt;
  for (const ParameterOverride& given : overrides)
    std::ranges::find(file.parameters, given.name, [](const ParameterDesc& p) {
      return p.name.text;
    })->value = given.value;
  if (timeSeconds) file.render.time = *timeSeconds;
  return writeScene(file);
}

}  // namespace luxo
