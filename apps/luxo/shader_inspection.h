// SPDX-License-Identifier: Apache-2.0
// luxo inspect SHADER: what a shader asks of whoever runs it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace luxo {

struct ShaderUse;

/// Whether a file is a shader, by its suffix.
[[nodiscard]] bool isShader(const std::string& path);

/// Of GLSL (.vert, .tesc, .tese, .geom, .frag, .comp; .glsl is a fragment shader's) or of SPIR-V (.spv). One
/// without a main function is a material's (shaders/MATERIALS.md), of which its uniforms are told, with the
/// values that the preset of `use` has. Its mainImage is meant where `use` says so, or where there is nothing
/// else. Throws Error(Scene) with what is wrong in it.
[[nodiscard]] nlohmann::ordered_json inspectShader(const std::string& path, const ShaderUse& use);
[[nodiscard]] std::string shaderText(const nlohmann::ordered_json& json);

}  // namespace luxo
