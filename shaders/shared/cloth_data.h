// SPDX-License-Identifier: Apache-2.0
// What the CPU hands to cloth.comp: one definition for C++ and GLSL, scalar block layout. Metres, seconds, kilograms.
#ifndef LUXO_SHARED_CLOTH_DATA_H
#define LUXO_SHARED_CLOTH_DATA_H
#include "shared/types.h"

#ifdef __cplusplus
namespace luxo::shared {
#endif

LUXO_CONSTANT kSetCloth = 0;
LUXO_CONSTANT kBindingClothPoints = 0;
LUXO_CONSTANT kBindingClothIterations = 1;
LUXO_CONSTANT kClothBindings = 2;

LUXO_CONSTANT kClothInvocations = 128;  // what every device has in a workgroup

// Parts of the buffer of points, each as long as there are points.
LUXO_CONSTANT kClothPlaces = 0;      // and mass, below 0 of what is pinned
LUXO_CONSTANT kClothVelocities = 1;  // and row sum (ClothSystem)
LUXO_CONSTANT kClothMoves = 2;       // two of them, by turns
LUXO_CONSTANT kClothChanges = 4;     // of the moves, in the last iteration
LUXO_CONSTANT kClothForces = 5;      // and whether the ball touches
LUXO_CONSTANT kClothParts = 6;

struct ClothData {
  uint columns, rows;  // cells
  uint steps;
  uint iterations;     // of one run, of two
  float step;
  float damping, friction;  // per second
  float restX, restZ, restDiagonal;
  float stretchX, stretchZ, diagonal, bendX, bendZ;  // as in ClothSystem
  float ballRadius;
  vec3 ballCenter, gravity;
};

#ifdef __cplusplus
static_assert(sizeof(ClothData) == 88);
static_assert(kClothMoves + 2 == kClothChanges && kClothForces + 1 == kClothParts);
}  // namespace luxo::shared
#endif
#endif
