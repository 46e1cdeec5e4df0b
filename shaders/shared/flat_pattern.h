// SPDX-License-Identifier: Apache-2.0
// Of a caster of a planar shadow that has a pattern or a map: behind FlatShadow, of which one is pushed for each draw. C++ and
// GLSL.
#ifndef LUXO_SHARED_FLAT_PATTERN_H
#define LUXO_SHARED_FLAT_PATTERN_H
#include "shared/scene_data.h"

#ifdef __cplusplus
namespace luxo::shared {
#endif

struct FlatPattern {
  uint firstPatternParameter;
  float opacity;      // times that of its pattern or its map
  float leastOpaque;  // lib/cutoff.glsl
  uint tintsLight;    // by its colour
};

#ifdef __cplusplus
static_assert(sizeof(FlatPattern) == 16 && sizeof(FlatShadow) + sizeof(FlatPattern) <= 128, "pushed together");
}  // namespace luxo::shared
#endif
#endif
