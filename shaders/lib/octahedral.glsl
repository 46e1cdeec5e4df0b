// SPDX-License-Identifier: Apache-2.0
// Unit vectors folded onto an octahedron (Meyer et al. 2010).
#ifndef LUXO_LIB_OCTAHEDRAL_GLSL
#define LUXO_LIB_OCTAHEDRAL_GLSL

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

// In 32 bits, not all of which are 0.
uint packedOctahedral(vec2 p) { return max(packUnorm2x16(0.5 * p + 0.5), 1u); }
vec2 unpackedOctahedral(uint packed_) { return 2.0 * unpackUnorm2x16(packed_) - 1.0; }

#endif
