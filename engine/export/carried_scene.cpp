// SPDX-License-Identifier: Apache-2.0
#include "export/carried_scene.h"

#include <algorithm>

#include "scene/model_files.h"
#include "scene/scene_writer.h"
#include "scene/shader_files.h"
#include "scene/texture_files.h"

namespace luxo {

CarriedScene carriedScene(SceneFile file, std::span<const ParameterOverride> overrides,
                          std::optional<double> timeSeconds) {
  for (const ParameterOverride& given : overrides)
    std::ranges::find(file.parameters, given.name, [](const ParameterDesc& p) {
      return p.name.text;
    })->value = given.value;
  if (timeSeconds) file.render.time = *timeSeconds;
  CarriedScene carried{.text = writeScene(file), .files = {}};
  const auto carry = [&](const auto& files) {
    if (files) carried.files.merge(files->inMemory());
  };
  carry(file.source.textures);
  carry(file.source.models);
  carry(file.source.shaders);
  return carried;
}

}  // namespace luxo
