// SPDX-License-Identifier: Apache-2.0
// When loops of shaders that others write end: C++ and GLSL. Nothing else is here, as such shaders see these names.
#ifndef LUXO_SHARED_LOOP_ROUNDS_H
#define LUXO_SHARED_LOOP_ROUNDS_H
#include "shared/types.h"

#ifdef __cplusplus
namespace luxo::shared {
#endif

// So many rounds, all loops of a point together: draw/bounded_loops.h has them ask. Half of where Mesa's llvmpipe ends a loop
// by itself, and tells nobody (LP_MAX_TGSI_LOOP_ITERATIONS, 65535).
LUXO_CONSTANT kLuxoMaxRounds = 32768;

#ifdef __cplusplus
}  // namespace luxo::shared
#endif
#endif
