// SPDX-License-Identifier: Apache-2.0
// Of a caster of a planar shadow that is cut out: behind FlatShadow, of which one is pushed for each draw. C++ and GLSL.
#ifndef LUXO_SHARED_FLAT_CUTOUT_H
#define LUXO_SHARED_FLAT_CUTOUT_H
#include "shared/scene_data.h"

#ifdef __cplusplus
namespace luxo::shared {
#endif

struct FlatCutout {
  uint firstPatternParameter;
  float opacity;      // times the alpha of its map
  float leastOpaque;  // lib/cutoff.glsl
};

#ifdef __cplusplus
}  // namespace luxo::shared
#endif
#endif
