// SPDX-License-Identifier: Apache-2.0
// The text of a material's shader, made safe to join with luxo's own.
#pragma once

#include <string>
#include <string_view>

#include "scene/material_shader.h"

namespace luxo {

/// Names of what a material is given (shaders/MATERIALS.md), and of luxo's own beside it.
[[nodiscard]] bool isGivenToMaterials(std::string_view name);
/// Whether a name may follow a dot in a shader: of what it is given, or of a vector.
[[nodiscard]] bool isFieldOfMaterials(std::string_view name);

/// As joined texts need it: with bounded loops, and uniforms where luxo's own numbers are.
[[nodiscard]] std::string joinable(std::string_view glsl);

/// Error(Scene), at its place: a directive says what it must not. Macros with names of luxo's own change what
/// is joined with the text, a pragma that nobody knows does nothing, and an extension is of some devices
/// only.
void refuseDirectives(const MaterialShader::File& file);

}  // namespace luxo
