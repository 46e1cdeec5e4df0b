// SPDX-License-Identifier: Apache-2.0
// What compilers say of a material's shader, in its user's words and at its own lines.
#pragma once

#include <string>
#include <string_view>

#include "scene/material_shader.h"

namespace luxo {

/// Error(Scene): what is wrong with the shader, of what a compiler said of the program that begins with
/// `entry` and stands in one of luxo's own; `course`: in the course's style.
[[noreturn]] void explainRefusal(const MaterialShader& shader, const std::string& entry, bool course,
                                 std::string_view said);

/// Error(Scene), at the place: a file of the shader opens a condition or a brace that it does not close, by
/// what a compiler said of that.
void refuseUnclosed(const MaterialShader& shader, std::string_view said);

/// A message about a program in the course's style, or about any other, with names as its file spells them.
[[nodiscard]] std::string asProgramsSpell(std::string_view message);
[[nodiscard]] std::string asFilesSpell(std::string_view message);

}  // namespace luxo
