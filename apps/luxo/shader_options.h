// SPDX-License-Identifier: Apache-2.0
// What render, view, lab and inspect take for a shader file beside the options of all scenes.
#pragma once

#include <optional>
#include <string>

#include "options.h"
#include "shader_scene.h"

namespace luxo {

struct ShaderOptions {
  bool mainImage = false;
  std::optional<std::string> preset;
};

/// --shadertoy and --preset. `options` outlives the command.
void addShaderOptions(CLI::App& command, ShaderOptions& options);

/// With its preset read. Error(Usage): the file is no shader, and an option is for one; there is no such
/// preset.
[[nodiscard]] ShaderUse shaderUse(const std::string& file, const ShaderOptions& options);

}  // namespace luxo
