// SPDX-License-Identifier: Apache-2.0
// The places that pixels see, the same all over the target.
#ifndef LUXO_LIB_PLACE_INTERFACE_GLSL
#define LUXO_LIB_PLACE_INTERFACE_GLSL
#include "shared/scene_data.h"

#ifdef LUXO_VERTEX
#define LUXO_VARYING out
#else
#define LUXO_VARYING in
#endif

layout(location = 0) flat LUXO_VARYING vec3 varyingPlace[3];  // middle, right, down, as in ViewData
layout(location = 3) flat LUXO_VARYING vec3 varyingRay[3];
layout(location = 6) flat LUXO_VARYING vec4 varyingMiddle;    // x, y; whether perspective; the depth of what positions are relative to
#endif
