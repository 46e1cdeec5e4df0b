// SPDX-License-Identifier: Apache-2.0
// The surface that a search is for, its formula and its place in the picture, in numbers that the search computes with:
// float, or double where LUXO_DOUBLE is defined, for views that magnify what float rounds away.
#ifdef LUXO_DOUBLE
#include "lib/double_math.glsl"
#define real double
#define real2 dvec2
#define real3 dvec3
#define real4 dvec4
#else
#include "lib/formula.glsl"
#define real float
#define real2 vec2
#define real3 vec3
#define real4 vec4
#endif

layout(constant_id = 5) const uint kParameterCount = 0;

#ifdef LUXO_DOUBLE

layout(scalar, set = 3, binding = kBindingPreciseInstances) readonly buffer PreciseInstances {
  PreciseInstance preciseInstances[];
};
layout(scalar, set = 3, binding = kBindingPreciseParameters) readonly buffer PreciseParameters { double preciseParameters[]; };

real4 rowX, rowY, rowDepth;  // as in ExactInstance
real4 patchDomain;                // lowest u and v, highest u and v
// A CPU device reads a buffer slowly: once, not whenever the formula is.
const uint kHeldParameters = 64;
const bool kReadsSurface = true;
double heldParameters[kHeldParameters];

void readSurface() {
  rowX = preciseInstances[linkFlags.w].x;
  rowY = preciseInstances[linkFlags.w].y;
  rowDepth = preciseInstances[linkFlags.w].depth;
  uint first = linkFlags.y;
  for (uint k = 0; k < kDomainNumbers; ++k) patchDomain[k] = preciseParameters[first - kDomainNumbers + k];
  for (uint k = 0; k < kHeldParameters; ++k)
    if (k < kParameterCount) heldParameters[k] = preciseParameters[first + k];
}

double surfaceParameterAt(uint k) {
  return k < kHeldParameters ? heldParameters[k] : preciseParameters[linkFlags.y + k];
}

// Relative to the eye.
vec3 relativePosition(real3 S) {
  PreciseInstance exact = preciseInstances[linkFlags.w];
  return vec3(dot(exact.relativeX.xyz, S) + exact.relativeX.w, dot(exact.relativeY.xyz, S) + exact.relativeY.w,
              dot(exact.relativeZ.xyz, S) + exact.relativeZ.w);
}

#else

#define rowX linkX
#define rowY linkY
#define rowDepth linkDepth
#define patchDomain linkDomain

layout(scalar, set = 2, binding = kBindingExactParameters) readonly buffer ExactParameters { float exactParameters[]; };
// A CPU device reads a buffer slowly: parameters that are not carried are read once, not whenever the formula is.
const uint kHeldParameters = 32;
const uint kNotCarried = kParameterCount > kCarriedParameters ? kParameterCount - kCarriedParameters : 0;
const uint kHeld = kNotCarried < kHeldParameters ? kNotCarried : kHeldParameters;
const bool kReadsSurface = kHeld > 0;
float heldParameters[kHeldParameters];

void readSurface() {
  for (uint k = 0; k < kHeld; ++k) heldParameters[k] = exactParameters[linkFlags.y + kCarriedParameters + k];
}

float surfaceParameterAt(uint k) {
  uint held = k - kCarriedParameters;
  return k < kCarriedParameters ? packed(kFirstParameter + k)
         : held < kHeldParameters ? heldParameters[held]
                                  : exactParameters[linkFlags.y + k];
}

// Relative to the eye.
vec3 relativePosition(vec3 S) {
  return linkRelative[0].xyz * S.x + linkRelative[1].xyz * S.y + linkRelative[2].xyz * S.z +
         vec3(linkRelative[0].w, linkRelative[1].w, linkRelative[2].w);
}

#endif

// The formula: void surfaceAt(real u, real v, out real3 S, out real3 Su, out real3 Sv).
#define parameterAt surfaceParameterAt
#include "surface"
#undef parameterAt
