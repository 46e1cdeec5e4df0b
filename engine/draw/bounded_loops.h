// SPDX-License-Identifier: Apache-2.0
// Loops of shaders that others write: each asks, every time round, whether it may go on.
#pragma once

#include <string>
#include <string_view>

namespace luxo {

/// The same lines, where `#version` is blank (there is one in what includes them) and every `for`, `while`
/// and `do` begins what it repeats with one word more, LUXO_ASKS, which is `if (luxoStops()) break; else`
/// (shaders/lib/material.glsl). Loops that only a macro's expansion spells are left alone.
[[nodiscard]] std::string withBoundedLoops(std::string_view glsl);

}  // namespace luxo
