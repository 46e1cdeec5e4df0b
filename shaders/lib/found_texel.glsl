// SPDX-License-Identifier: Apache-2.0
// A found point as four floats: its depth beyond what positions are relative to, its normal, and its residual with the
// number of its material.
//
// The normal is folded onto an octahedron (Meyer et al. 2010), all digits kept: with 16 bits highlights would be off by
// 1e-4. The last float is the residual, rounded up to the 16 upper bits, with the material in the lower ones; it is a
// number of its own, neither subnormal nor NaN, so that no float format changes its bits.
#include "lib/found.glsl"
#include "lib/scene.glsl"

const float kLeastResidual = 1e-30;

vec2 signs(vec2 v) { return vec2(v.x < 0.0 ? -1.0 : 1.0, v.y < 0.0 ? -1.0 : 1.0); }

vec2 octahedral(vec3 n) {
  vec2 p = n.xy / max(abs(n.x) + abs(n.y) + abs(n.z), 1e-37);
  return n.z < 0.0 ? (1.0 - abs(p.yx)) * signs(p) : p;
}

vec3 fromOctahedral(vec2 p) {
  vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
  if (n.z < 0.0) n.xy = (1.0 - abs(n.yx)) * signs(n.xy);
  return n * inversesqrt(dot(n, n));
}

vec4 foundTexel(Found found, uint material) {
  uint upper = floatBitsToUint(max(abs(found.residual), kLeastResidual)) + 0xffffu & 0xffff0000u;
  uint sign_ = found.residual < 0.0 ? 0x80000000u : 0u;
  return vec4(dot(found.position, view.forward.xyz), octahedral(found.normal), uintBitsToFloat(upper | sign_ | material));
}

uint materialOfTexel(vec4 texel) { return floatBitsToUint(texel.w) & 0xffffu; }
