// SPDX-License-Identifier: Apache-2.0
// The exact shaders that were compiled when luxo was built: those of the named surfaces
// (shaders/exact/emit.cpp).
#pragma once

#include <cstdint>
#include <span>

#include "surface/surface_code.h"

namespace luxo {

/// The fragment shader that finds this surface, made of exact/surface.frag; empty for other surfaces. Looked
/// up by the formula itself: one that has changed never meets an older shader.
[[nodiscard]] std::span<const std::uint32_t> builtInExactShader(const SurfaceCode& surface);

}  // namespace luxo
