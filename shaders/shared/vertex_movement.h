// SPDX-License-Identifier: Apache-2.0
// What the CPU hands to lib/vertex_movement.glsl: one definition for C++ and GLSL, scalar block layout. Metres, object
// space.
#ifndef LUXO_SHARED_VERTEX_MOVEMENT_H
#define LUXO_SHARED_VERTEX_MOVEMENT_H

#ifdef __cplusplus
#include <cstdint>

#include "math/vec.h"
namespace luxo::shared {
using vec2 = Vec2f;
using vec3 = Vec3f;
using mat4 = Mat4f;
using uint = std::uint32_t;
#define LUXO_CONSTANT inline constexpr uint
#else
#extension GL_EXT_scalar_block_layout : require
#define LUXO_CONSTANT const uint
#endif

LUXO_CONSTANT kSetMovement = 0;
LUXO_CONSTANT kBindingMovedVertices = 0;
LUXO_CONSTANT kBindingMovementNumbers = 1;  // of the material: kShaderNumbers others, and its uniforms
LUXO_CONSTANT kBindingMovementStates = 2;
LUXO_CONSTANT kBindingMovedPositions = 3;   // one a vertex of the first state, then of the second
LUXO_CONSTANT kBindingMovementFaults = 4;   // how many vertices' loops do not end
LUXO_CONSTANT kMovementBindings = 5;

LUXO_CONSTANT kMovementInvocations = 64;
LUXO_CONSTANT kMovementStates = 2;

struct VertexAtRest {
  vec3 position, normal;
  vec2 uv;
};

// What a program may ask for beside its vertex and its uniforms.
struct MovementState {
  mat4 modelView, projection, modelViewInverse, projectionInverse;
  vec3 ambient, diffuse, specular;  // of the material
  float shininess;
  float other;  // what stands for numbers that a movement must not depend on: lights, tangents, texels
};

struct MovementRange {
  uint first, count, vertices;  // of a dispatch; and all
};

#ifdef __cplusplus
#undef LUXO_CONSTANT
static_assert(sizeof(VertexAtRest) == 32 && sizeof(MovementState) == 300 && sizeof(MovementRange) == 12);
}  // namespace luxo::shared
#endif
#endif
