// SPDX-License-Identifier: Apache-2.0
// The interpolated colour of the side that is seen.
#version 460

layout(location = 0) sample in vec4 inFront;
layout(location = 1) sample in vec4 inBack;

layout(location = 0) out vec4 outColor;

void main() { outColor = gl_FrontFacing ? inFront : inBack; }
