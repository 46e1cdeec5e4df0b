// SPDX-License-Identifier: Apache-2.0
// A planar shadow: the bit of its light.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/flat_shadow.glsl"

layout(location = 0) out uint outShadows;

void main() {
  if (!isInFlatShadow()) discard;
  outShadows = 1u << draw.light;
}
