// SPDX-License-Identifier: Apache-2.0
// Names of types and constants that C++ and GLSL have in common.
#ifndef LUXO_SHARED_TYPES_H
#define LUXO_SHARED_TYPES_H

#ifdef __cplusplus
#include <cstdint>

#include "math/vec.h"
namespace luxo::shared {
using vec2 = Vec2f;
using vec3 = Vec3f;
using vec4 = Vec4f;
using mat3 = Mat3f;
using mat4 = Mat4f;
using uint = std::uint32_t;
}  // namespace luxo::shared
#define LUXO_CONSTANT inline constexpr luxo::shared::uint
#define LUXO_NUMBER inline constexpr float
#else
#extension GL_EXT_scalar_block_layout : require
#define LUXO_CONSTANT const uint
#define LUXO_NUMBER const float
#endif
#endif
