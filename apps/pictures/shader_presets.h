// SPDX-License-Identifier: Apache-2.0
// Values of a shader's uniforms that were worth keeping, in a file beside it: steel.frag.presets.json.
//
//     { "presets": { "copper": { "metal": [0.8, 0.5, 0.3], "grooves": 90, "pattern": "brushed" } } }
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "option_values.h"

namespace luxo {

/// As -P would give them, by the presets' names.
using ShaderPresets = std::map<std::string, std::vector<ParameterValue>>;

[[nodiscard]] std::filesystem::path presetFileOf(const std::string& shader);

/// None where there is no such file. Error(Scene): it is no file of presets, with its place or its names.
[[nodiscard]] ShaderPresets readPresets(const std::string& shader);

/// Error(Usage): the shader has none of that name.
[[nodiscard]] std::vector<ParameterValue> presetOf(const std::string& shader, const std::string& name);

/// Writes the file; whole, or not at all. Error(Write): it cannot be.
void writePresets(const std::string& shader, const ShaderPresets& presets);

}  // namespace luxo
