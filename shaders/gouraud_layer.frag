// SPDX-License-Identifier: Apache-2.0
// The interpolated colour of the side that is seen, and seen through.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/layer_lit.glsl"

layout(location = 0) sample in vec4 inFront;
layout(location = 1) sample in vec4 inBack;
layout(location = 6) flat in uvec3 inNumbers;

void main() {
  vec4 color = gl_FrontFacing ? inFront : inBack;
  addLitLayer(inNumbers.y, color.rgb, color.a, materials[inNumbers.y].diffuse);
}
