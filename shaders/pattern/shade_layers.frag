// SPDX-License-Identifier: Apache-2.0
// The light on what is seen through, on a pattern.
#version 460
#extension GL_GOOGLE_include_directive : require
#define LUXO_SHADOWS
#include "lib/shade_layers.glsl"
#include "lib/lit_pattern.glsl"

uint firstPatternParameter() { return material.firstPatternParameter; }
vec4 patternBounds() { return vec4(vec2(-3e38), vec2(3e38)); }  // what was found is within them

vec4 paintOf(Found found) {
#ifdef LUXO_SHADER
  vec3 tint = material.blend == kBlendMultiply ? paintAt(found.parameters).rgb : material.diffuse;
  return vec4(tint, material.opacity * litOpacity);
#else
  vec4 paint = paintAt(found.parameters);
  return vec4(paint.rgb, material.opacity * paint.a);
#endif
}

void main() { shadeLayers(); }
