// SPDX-License-Identifier: Apache-2.0
// Light per vertex where there are shadows.
#version 460
#extension GL_GOOGLE_include_directive : require
layout(location = 0) out vec4 outColor;

#include "lib/gouraud_again.glsl"
#include "lib/again_found.glsl"

void main() { lightBetweenVertices(vec4(inDiffuse, inOpacity)); }
