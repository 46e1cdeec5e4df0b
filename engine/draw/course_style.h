// SPDX-License-Identifier: Apache-2.0
// GLSL in the style of 1.10 and 1.20, as courses write it: `varying`, `attribute`, gl_LightSource,
// ftransform. shaders/MATERIALS.md is its page, shaders/lib/course.glsl what such programs have by
// themselves.
//
// The language that luxo compiles has given up those words, keeps others for itself, and lets nobody declare
// a name that begins with gl_. So they get a spelling of luxo's own, with a capital as their second letter
// (gL_Vertex, vArying, sAmple), which no line or column is moved by, and which messages take back.
#pragma once

#include <set>
#include <string>
#include <string_view>

#include "scene/material_shader.h"

namespace luxo {

/// Whether it is a program: it has a `main`, and uses words of the style, or says `#pragma luxo course`.
[[nodiscard]] bool inCourseStyle(const MaterialShader& shader);

/// The text with luxo's spelling of the style's words.
[[nodiscard]] std::string withCourseSpelling(std::string_view glsl);
/// Takes it back, anywhere in a text.
[[nodiscard]] std::string withoutCourseSpelling(std::string_view text);

/// The text with `prefix` before each of the names: where they are names of what it declares, not of what a
/// structure has.
[[nodiscard]] std::string renamed(std::string_view glsl, const std::set<std::string, std::less<>>& names,
                                  std::string_view prefix);

/// Error(Scene), at its place: the file is of another language, or asks for what there is not.
void refuseForeign(const MaterialShader::File& file);

}  // namespace luxo
