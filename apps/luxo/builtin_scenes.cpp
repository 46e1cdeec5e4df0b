// SPDX-License-Identifier: Apache-2.0
#include "builtin_scenes.h"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <vector>

#include "base/error.h"
#include "base/suggestion.h"
#include "luxo_grandpa/lamp.h"
#include "scenes/gallery.h"

namespace luxo {

std::span<const BuiltinScene> builtinScenes() {
  static constexpr std::array kScenes = {
      BuiltinScene{"luxo-grandpa", "the lamp of the lecture, turning for ever", luxoGrandpa},
      BuiltinScene{"gallery", "the named surfaces side by side", gallery},
  };
  return kScenes;
}

Scene openScene(const std::string& scene) {
  std::vector<std::string> names;
  for (const BuiltinScene& builtin : builtinScenes()) {
    if (scene == builtin.name) return builtin.build();
    names.emplace_back(builtin.name);
  }
  std::error_code ignored;
  if (std::filesystem::exists(scene, ignored))
    throw Error(ErrorKind::Scene, fmt::format("'{}': scene and model files are not supported yet", scene),
                fmt::format("the built-in scenes are {}", listed(names)));
  throw Error(ErrorKind::Scene, fmt::format("there is no scene '{}'", scene),
              didYouMean(scene, names, fmt::format("the built-in scenes are {}", listed(names))));
}

}  // namespace luxo
