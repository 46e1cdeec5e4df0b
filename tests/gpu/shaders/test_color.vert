// SPDX-License-Identifier: Apache-2.0
// Passes on a clip-space position and a colour.
#version 460
layout(location = 0) in vec3 positionClip;
layout(location = 1) in vec4 color;
layout(location = 0) out vec4 outColor;

void main() {
  gl_Position = vec4(positionClip, 1.0);
  outColor = color;
}
