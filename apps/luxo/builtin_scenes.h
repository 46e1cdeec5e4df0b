// SPDX-License-Identifier: Apache-2.0
// The scenes every luxo carries, by name.
#pragma once

#include <span>
#include <string>

#include "scene/scene.h"

namespace luxo {

struct BuiltinScene {
  const char* name;
  const char* summary;
  Scene (*build)();
};

[[nodiscard]] std::span<const BuiltinScene> builtinScenes();

/// The scene that SCENE on a command line means. Error(Scene): there is none of that name, or the name is a
/// file of a kind that cannot be read yet.
[[nodiscard]] Scene openScene(const std::string& scene);

}  // namespace luxo
