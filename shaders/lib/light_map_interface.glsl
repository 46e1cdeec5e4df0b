// SPDX-License-Identifier: Apache-2.0
// What a draw of a light's depth map tells its fragments, the same all over the target: a device reads a buffer more slowly.
#include "shared/scene_data.h"

#ifdef LUXO_VERTEX
#define LUXO_VARYING out
#else
#define LUXO_VARYING in
#endif

layout(location = 0) flat LUXO_VARYING vec3 varyingPlace[3];  // middle, right, down, as in ViewData
layout(location = 3) flat LUXO_VARYING vec3 varyingRay[3];
layout(location = 6) flat LUXO_VARYING vec2 varyingMiddle;
layout(location = 7) flat LUXO_VARYING vec3 varyingFace[4];   // the first: right, down, forward, origin
layout(location = 11) flat LUXO_VARYING vec4 varyingLight;
layout(location = 12) flat LUXO_VARYING vec4 varyingTexel;    // its width, half the map's size, both of `depthOfBuffer`
layout(location = 13) flat LUXO_VARYING vec4 varyingBias;     // bias, slope bias, normal offset, the light's radius
layout(location = 14) flat LUXO_VARYING uvec4 varyingMap;     // faces; pcf; whether receivers are planes; number of the map

layout(scalar, set = kSetShadow, binding = kBindingLightMaps) readonly buffer LightMaps { LightMap lightMaps[]; };
