// SPDX-License-Identifier: Apache-2.0
// The colour times a pushed tint plus a specialised offset; a number into a second attachment.
#version 460
layout(constant_id = 0) const float kOffset = 0.0;
layout(constant_id = 1) const uint kNumber = 0;
layout(push_constant) uniform Push { vec4 tint; };
layout(location = 0) in vec4 color;
layout(location = 0) out vec4 outColor;
layout(location = 1) out uint outNumber;

void main() {
  outColor = color * tint + kOffset;
  outNumber = kNumber;
}
