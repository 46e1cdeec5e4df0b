// SPDX-License-Identifier: Apache-2.0
// Light per vertex where there are shadows, on a pattern.
#version 460
#extension GL_GOOGLE_include_directive : require
layout(location = 0) out vec4 outColor;

#include "lib/gouraud_again.glsl"
#include "lib/pattern_of_mesh.glsl"
#ifdef LUXO_TEXTURED
vec4 pixelFootprint() { return vec4(dFdx(inParameters), dFdy(inParameters)); }
#define LUXO_ADDS_LIGHT kAddsLight
#include "lib/maps.glsl"
#endif
#include "lib/again_found.glsl"

void main() {
  vec4 paint = paintAt(inParameters);
  lightBetweenVertices(vec4(paint.rgb, inOpacity * paint.a));
}
