// SPDX-License-Identifier: Apache-2.0
// A planar shadow of what lets light through, here more and there less: each of its faces takes a part.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/flat_pattern.glsl"

layout(location = 0) out vec4 outTransmittance;

void main() {
  // Both for all fragments.
  vec4 paint = paintOfCaster();
  if (!isInFlatShadow()) discard;
  outTransmittance = vec4((1.0 - paint.a) * (caster.tintsLight != 0 ? paint.rgb : vec3(1)), 1);
}
