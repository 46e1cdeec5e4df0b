// SPDX-License-Identifier: Apache-2.0
// A planar shadow of what lets light through: each of its faces takes a part.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/flat_shadow.glsl"

layout(location = 0) out vec4 outTransmittance;

void main() {
  if (!isInFlatShadow()) discard;
  outTransmittance = vec4(draw.transmittance, 1);
}
