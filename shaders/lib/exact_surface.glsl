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
#include "lib/held_parameters.glsl"

layout(scalar, set = kSetExact, binding = kBindingExactParameters) readonly buffer ExactParameters { float exactParameters[]; };
// Of those that are not carried.
const uint kNotCarried = kParameterCount > kCarriedParameters ? kParameterCount - kCarriedParameters : 0;
const uint kHeld = kNotCarried < kHeldParameters ? kNotCarried : kHeldParameters;
real heldParameters[kHeldParameters];

real parameterFromBuffer(uint k) {
  uint first = 2 * (varyingFlags.y + k);
#ifdef LUXO_DOUBLE
  return real(exactParameters[first]) + real(exactParameters[first + 1]);
#else
  return exactParameters[first];
#endif
}

#ifdef LUXO_DOUBLE

real4 rowX, rowY, rowDepth;  // as in ExactInstance
real4 patchDomain;           // lowest u and v, highest u and v

real pair(uint k) { return real(packed(k)) + real(packed(k + 1)); }
real carriedParameter(uint k) { return pair(kFirstParameter + 2 * k); }

// Relative to the eye.
vec3 relativePosition(real3 S) {
  vec3 p = vec3(S - real3(pair(kMiddle), pair(kMiddle + 2), pair(kMiddle + 4)));
  return varyingRelative[0].xyz * p.x + varyingRelative[1].xyz * p.y + varyingRelative[2].xyz * p.z +
         vec3(varyingRelative[0].w, varyingRelative[1].w, varyingRelative[2].w);
}

#else

#define rowX varyingX
#define rowY varyingY
#define rowDepth varyingDepth
#define patchDomain varyingDomain

float carriedParameter(uint k) { return packed(kFirstParameter + k); }

// Relative to the eye.
vec3 relativePosition(vec3 S) {
  return varyingRelative[0].xyz * S.x + varyingRelative[1].xyz * S.y + varyingRelative[2].xyz * S.z +
         vec3(varyingRelative[0].w, varyingRelative[1].w, varyingRelative[2].w);
}

#endif

void readSurface() {
#ifdef LUXO_DOUBLE
  rowX = real4(varyingX) + real4(packed4(kFirstRowLow));
  rowY = real4(varyingY) + real4(packed4(kFirstRowLow + 4));
  rowDepth = real4(varyingDepth) + real4(packed4(kFirstRowLow + 8));
  if (!kEquation) patchDomain = real4(varyingDomain) + real4(packed4(kFirstDomainLow));
#endif
  for (uint k = 0; k < kHeld; ++k) heldParameters[k] = parameterFromBuffer(kCarriedParameters + k);
}

real surfaceParameterAt(uint k) {
  uint held = k - kCarriedParameters;
  return k < kCarriedParameters ? carriedParameter(k)
         : held < kHeldParameters ? heldParameters[held]
                                  : parameterFromBuffer(k);
}

// A device shades pixels together, and goes on with those that the triangle does not cover until all are done. They find
// their point like the others, unless what a CPU device reads from buffers for them is 0: where that is worth a read they
// are left out, by what they read of their instance, whose id is never 0.
const bool kLeavesOut = kDouble || kHeld > 0;
bool isLeftOut() { return kLeavesOut && instances[varyingFlags.w].id == 0; }

// The formula: void surfaceAt(real u, real v, out real3 S, out real3 Su, out real3 Sv).
#define parameterAt surfaceParameterAt
#include "surface"
#undef parameterAt

// A point's u, as the surface names it, is this more than that of the formula.
#ifdef LUXO_ORIGIN_OF_U
real originOfU() { return parameterFromBuffer(LUXO_ORIGIN_OF_U); }
#else
real originOfU() { return 0.0; }
#endif

// The patch's lowest u and v, highest u and v, as the surface calls them.
vec4 domainOfNames() { return varyingDomain + vec4(originOfU(), 0, originOfU(), 0); }
