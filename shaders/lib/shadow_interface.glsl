// SPDX-License-Identifier: Apache-2.0
// What a draw of shadows tells its fragments: the pixel's place, and the caster; the same all over the target.
#include "shared/scene_data.h"

#ifdef LUXO_VERTEX
#define LUXO_VARYING out
#else
#define LUXO_VARYING in
#endif

layout(location = 0) flat LUXO_VARYING vec3 varyingPlace[3];  // middle, right, down, as in ViewData
layout(location = 3) flat LUXO_VARYING vec3 varyingRay[3];
layout(location = 6) flat LUXO_VARYING vec4 varyingMiddle;    // x, y; whether perspective; the depth of what positions are relative to
layout(location = 7) flat LUXO_VARYING vec4 varyingGrid[3];   // rows: of gridFromRelative, and the origin
layout(location = 10) flat LUXO_VARYING vec4 varyingObject[3];
layout(location = 13) flat LUXO_VARYING vec4 varyingLightObject;
layout(location = 14) flat LUXO_VARYING vec4 varyingLightRelative;
layout(location = 15) flat LUXO_VARYING vec4 varyingRounding;  // once; for each metre; margin; a pixel's width
layout(location = 16) flat LUXO_VARYING uvec4 varyingFirst;    // entry, cell, parameter; parameters of each patch
layout(location = 17) flat LUXO_VARYING uvec4 varyingCaster;   // its index; the light's bit; flags below; grid size
// Of the face that looks at the caster's middle, where nearly all points are: its rectangle and its first texel.
layout(location = 18) flat LUXO_VARYING vec4 varyingFace;
layout(location = 19) flat LUXO_VARYING uint varyingFirstTexel;
layout(location = 20) flat LUXO_VARYING float varyingOff;  // pixels

const uint kFirstFace = 4;
const uint kParallel = 1, kGated = 2;

layout(scalar, set = kSetShadow, binding = kBindingCasters) readonly buffer Casters { ShadowCaster casters[]; };
