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

// Less than that floats do not tell of a cosine with a normal of what is there: the 16 bits of a mesh's leave 6e-5 of it.
const float kLeastCosine = 1e-4;

#ifndef LUXO_VERTEX
// The pixel's ray, to a depth of 1.
vec3 sightOfPixel() {
  vec2 pixel = gl_FragCoord.xy - varyingMiddle.xy;
  return varyingRay[0] + pixel.x * varyingRay[1] + pixel.y * varyingRay[2];
}

// Where the pixel's ray is at a depth beyond that of what positions are relative to.
vec3 placeAtDepth(float depth) {
  vec2 pixel = gl_FragCoord.xy - varyingMiddle.xy;
  return varyingPlace[0] + pixel.x * varyingPlace[1] + pixel.y * varyingPlace[2] + depth * sightOfPixel();
}
#endif
#endif
