// SPDX-License-Identifier: Apache-2.0
// A drawing in two levels with an outline that is seen through, of a pattern.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/layer_lit.glsl"
#include "lib/toon.glsl"
#include "lib/pattern_of_mesh.glsl"

void main() {
  vec4 paint = paintAt(inDetail.xy), color = drawnFragment(paint.rgb);
  addLitLayer(inNumbers.y, color.rgb, color.a * paint.a, paint.rgb);
}
