// SPDX-License-Identifier: Apache-2.0
// The exact shaders that were compiled when luxo was built, in float and in double: of the named surfaces
// without arguments and in general, of the built-in scenes, and of equations (shaders/exact/emit.cpp).
// SPIR-V, a word in each character (shaders/exact/table.h).
#pragma once

#include <string_view>

#include "draw/exact_source.h"
#include "surface/surface_code.h"

namespace luxo {

/// The fragment shader that finds this surface and shows the pattern, of this GLSL, if there is one; empty
/// for what is not built in. `parameters`: where points are lit later, their parameters are told, too. A
/// formula has one for where no ray may graze it, too, which is not `grazing`. Looked up by the formulas
/// themselves: one that has changed never meets an older shader. Cost: microseconds.
[[nodiscard]] std::u32string_view builtInExactShader(const SurfaceCode& surface,
                                                     std::string_view pattern = {}, bool grazing = true,
                                                     bool parameters = false);

/// The one that finds this of the surface, of formulas in float; empty for what is not built in.
[[nodiscard]] std::u32string_view builtInCasterShader(ExactSource::Caster caster, const SurfaceCode& surface,
                                                      std::string_view pattern = {});

/// The one of this name (shaders/pattern) that lights this pattern; empty for what is not built in.
[[nodiscard]] std::u32string_view builtInPatternShader(std::string_view name, std::string_view pattern);

}  // namespace luxo
