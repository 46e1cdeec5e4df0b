// SPDX-License-Identifier: Apache-2.0
// A drawing in two levels with an outline that is seen through.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/layer_lit.glsl"
#include "lib/toon.glsl"

void main() {
  vec4 color = drawnFragment(inDiffuse);
  addLitLayer(inNumbers.y, color.rgb, color.a, inDiffuse);
}
