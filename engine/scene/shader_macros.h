// SPDX-License-Identifier: Apache-2.0
// What a compiler is given once macros and files stand where their names do: a few lines may come to more
// than any machine holds, or to what is nested deeper than any stack is. Found before one tries.
#pragma once

#include <cstddef>

#include "scene/material_shader.h"

namespace luxo {

// Real shaders have some dozens of includes and ten thousand words; a compiler takes a second for these.
inline constexpr std::size_t kMaxIncludes = 1000, kMaxIncludedBytes = std::size_t{4} << 20,
                             kMaxExpandedWords = std::size_t{1} << 18;
/// Of brackets and operators. A compiler's stack is measured by it (gpu/deep_stack.h).
inline constexpr std::size_t kDeepestNesting = 2000;
/// Of statements and choices, which the compiler follows; a driver follows fewer (gpu::ShaderCost::nesting).
/// And of macros in arguments of macros.
inline constexpr std::size_t kDeepestStatements = 256, kDeepestArguments = 200;
/// Of a structure, those of its members among them: its name, which has all of them, is in that of each
/// function that takes one. And of functions that others call: a compiler looks through all of them for each.
inline constexpr std::size_t kMaxMembers = 256, kMaxCalls = 2048;

/// Error(Scene), at its place: the program that begins with files[first] comes to more. Conditions are not
/// computed: what is between `#if` and `#endif` counts and closes nothing around it, and of a macro all that
/// it may be.
void requireBounded(const MaterialShader& shader, std::size_t first = 0);

}  // namespace luxo
