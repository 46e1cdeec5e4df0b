// SPDX-License-Identifier: Apache-2.0
// Light per vertex, of what is seen through.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/gouraud_again.glsl"
#include "lib/again_layer.glsl"

void main() { lightBetweenVertices(vec4(inDiffuse, inOpacity)); }
