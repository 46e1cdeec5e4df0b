// SPDX-License-Identifier: Apache-2.0
// The formula of a surface, with the parameters of one of its patches after the other, and rectangles of these patches:
// varyingFirst, of whoever includes this, says where they are.
#include "lib/formula.glsl"
#include "lib/held_parameters.glsl"

layout(scalar, set = kSetShadow, binding = kBindingCasterCells) readonly buffer CasterCells { CasterCell casterCells[]; };
layout(scalar, set = kSetShadow, binding = kBindingCasterParameters) readonly buffer CasterParameters { float casterParameters[]; };

layout(constant_id = kConstantParameterCount) const uint kParameterCount = 0;
const uint kHeld = kParameterCount < kHeldParameters ? kParameterCount : kHeldParameters;
float heldParameters[kHeld > 0 ? kHeld : 1];
uint heldPatch = 0xffffffffu;  // whose they are

float casterParameterFromBuffer(uint k) { return casterParameters[varyingFirst.z + heldPatch * varyingFirst.w + k]; }

void holdPatch(uint patch_) {
  if (patch_ == heldPatch) return;
  heldPatch = patch_;
  for (uint k = 0; k < kHeld; ++k) heldParameters[k] = casterParameterFromBuffer(k);
}

// Short loops of a known length are none on a device.
const uint kUnrolled = 16;
int roundsToHold(uint patch_) { return patch_ == heldPatch || kHeld <= kUnrolled ? 0 : int(kHeld); }

float casterParameterAt(uint k) { return k < kHeld ? heldParameters[k] : casterParameterFromBuffer(k); }

// The formula: void surfaceAt(float u, float v, out vec3 S, out vec3 Su, out vec3 Sv).
#define parameterAt casterParameterAt
#include "surface"
#undef parameterAt
