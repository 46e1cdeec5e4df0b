// SPDX-License-Identifier: Apache-2.0
// The lights of a draw, in a uniform buffer. A CPU device reads it anew for every pixel and every number, which takes
// longer than the light itself: shading per fragment takes the first few lights from the vertices instead, as
// attributes that are the same all over the draw, and only the others from here.
#ifndef LUXO_LIB_LIGHTS_GLSL
#define LUXO_LIB_LIGHTS_GLSL
#include "shared/scene_data.h"

layout(scalar, set = kSetScene, binding = kBindingLights) uniform Lights { LightSet lightSet; };

SpotData spotAt(uint i) { return lightSet.spots[i]; }

#endif
