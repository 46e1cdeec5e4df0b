// SPDX-License-Identifier: Apache-2.0
// A found point as four floats: its depth beyond what positions are relative to, its normal, and its residual with the
// number of its material.
//
// The normal (lib/octahedral.glsl) keeps all digits: with 16 bits highlights would be off by 1e-4. The last float is the
// residual, rounded up to the 12 upper bits, which is by an eighth at most, with the material in the lower ones; it is a
// number of its own, neither subnormal nor NaN, so that no float format changes its bits.
#include "lib/found.glsl"
#include "lib/material_of_texel.glsl"
#include "lib/octahedral.glsl"
#include "lib/scene.glsl"

const float kLeastResidual = 1e-30;

vec4 foundTexel(Found found, uint material) {
  uint upper = floatBitsToUint(max(abs(found.residual), kLeastResidual)) + kMaterialBits & ~kMaterialBits;
  uint sign_ = found.residual < 0.0 ? 0x80000000u : 0u;
  return vec4(dot(found.position, view.forward.xyz), octahedral(found.normal), uintBitsToFloat(upper | sign_ | material));
}
