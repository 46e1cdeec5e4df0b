// SPDX-License-Identifier: Apache-2.0
// What the vertices of a shell tell its fragments: all but the start of the search is the same all over a triangle.
#include "lib/light_counts.glsl"
#include "lib/lights.glsl"
#include "lib/quantity.glsl"
#include "shared/scene_data.h"

#ifdef LUXO_VERTEX
#define LUXO_VARYING out
#else
#define LUXO_VARYING in
#endif

// u and v, or a point near an equation's surface, object space; then 1. Read by startAtEntry().
layout(location = 0) sample LUXO_VARYING vec4 varyingStart;
layout(location = 1) flat LUXO_VARYING vec4 varyingAmbientShininess;
layout(location = 2) flat LUXO_VARYING vec3 varyingDiffuse;
layout(location = 3) flat LUXO_VARYING vec4 varyingSpecularTolerance;
// Of the instance, its material, the patch and the draw; firstParameter; firstPatternParameter, or, where the light falls
// later, the material's number; the instance's index.
layout(location = 4) flat LUXO_VARYING uvec4 varyingFlags;
layout(location = 5) flat LUXO_VARYING vec4 varyingViewerSecond;  // viewer; how much derivatives change over a cell, metres
layout(location = 6) flat LUXO_VARYING vec4 varyingX;
layout(location = 7) flat LUXO_VARYING vec4 varyingY;
layout(location = 8) flat LUXO_VARYING vec4 varyingDepth;
layout(location = 9) flat LUXO_VARYING vec4 varyingRelative[3];   // columns of relativeFromObject; where `middle` is
layout(location = 12) flat LUXO_VARYING vec4 varyingDomain;
layout(location = 13) flat LUXO_VARYING vec4 varyingCellHalf;     // extent of the cells in u and v; half the picture
layout(location = 14) flat LUXO_VARYING vec3 varyingClip;         // clipDepth; thickness

bool has(uint flag) { return (varyingFlags.x & flag) != 0; }

layout(constant_id = kConstantParameterCount) const uint kParameterCount = 0;
layout(constant_id = kConstantEquation) const bool kEquation = false;  // whether the surface is searched for by its equation
// Whether it is searched for in double.
#ifdef LUXO_DOUBLE
const bool kDouble = true;
#else
const bool kDouble = false;
#endif

// What differs in length shares one array: lights and shades as far as they are carried, what makes numbers double, then
// as many parameters of the formula as there is room for: with these, vertices have all the outputs that devices commonly
// allow. What does not fit is read from buffers, which takes a CPU device longer.
const uint kRoom = kVaryings - kLocationPacked;
layout(location = kLocationPacked) flat LUXO_VARYING vec4 varyingPacked[kRoom];
const uint kLights = kPlainLights + kShadedLights;
const uint kVaryingLights = kLights < kCarriedLights ? kLights : kCarriedLights;
const uint kVaryingShades = kShadedLights < kCarriedShades ? kShadedLights : kCarriedShades;
const uint kFirstShade = kLightNumbers * kVaryingLights;
const uint kFirstRowLow = kFirstShade + kShadeNumbers * kVaryingShades;  // of x, y and depth
const uint kMiddle = kFirstRowLow + (kDouble ? 12 : 0);                 // in pairs
const uint kFirstDomainLow = kMiddle + (kDouble ? 6 : 0);
const uint kFirstParameter = kFirstDomainLow + (kDouble && !kEquation ? 4 : 0);
const uint kFloats = kDouble ? 2 : 1;  // of each parameter
const uint kCarriedParameters = (4 * kRoom - kFirstParameter) / kFloats;

#ifdef LUXO_VERTEX
void pack(uint k, float number) { varyingPacked[k / 4][k % 4] = number; }
void pack3(uint k, vec3 numbers) {
  for (uint i = 0; i < 3; ++i) pack(k + i, numbers[i]);
}
#else
layout(constant_id = kConstantManySamples) const bool kManySamples = false;

// llvmpipe takes inputs of a sample times the w of the pixel's centre over that of the sample, and so the 1.
vec3 startAtEntry() { return kManySamples ? varyingStart.xyz / varyingStart.w : varyingStart.xyz; }

float packed(uint k) { return varyingPacked[k / 4][k % 4]; }
vec3 packed3(uint k) { return vec3(packed(k), packed(k + 1), packed(k + 2)); }
vec4 packed4(uint k) { return vec4(packed3(k), packed(k + 3)); }
#endif
