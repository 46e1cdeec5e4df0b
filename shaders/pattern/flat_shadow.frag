// SPDX-License-Identifier: Apache-2.0
// A planar shadow of what is cut out: the bit of its light, where it is no hole.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/flat_pattern.glsl"

layout(location = 0) out uint outShadows;

void main() {
  // Both for all fragments.
  vec4 paint = paintOfCaster();
  if (!isInFlatShadow() || paint.a == 0.0) discard;
  outShadows = 1u << draw.light;
}
