// SPDX-License-Identifier: Apache-2.0
// What the CPU hands to lib/vertex_movement.glsl: one definition for C++ and GLSL, scalar block layout. Metres, object
// space.
#ifndef LUXO_SHARED_VERTEX_MOVEMENT_H
#define LUXO_SHARED_VERTEX_MOVEMENT_H
#include "shared/types.h"

#ifdef __cplusplus
namespace luxo::shared {
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
static_assert(sizeof(VertexAtRest) == 32 && sizeof(MovementState) == 300 && sizeof(MovementRange) == 12);
}  // namespace luxo::shared
#endif
#endif
