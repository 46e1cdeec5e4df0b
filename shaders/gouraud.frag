// SPDX-License-Identifier: Apache-2.0
// The interpolated colour of the side that is seen.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/bindings.h"

layout(location = kLocationFront) sample in vec4 inFront;
layout(location = kLocationBack) sample in vec4 inBack;

layout(location = 0) out vec4 outColor;

void main() { outColor = gl_FrontFacing ? inFront : inBack; }
