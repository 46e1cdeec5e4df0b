// SPDX-License-Identifier: Apache-2.0
// A planar shadow of what is cut out: the bit of its light, where it is no hole.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/flat_shadow.glsl"
#include "lib/cutoff.glsl"
#include "lib/pattern.glsl"

layout(location = 1) in vec2 inParameters;
layout(location = 0) out uint outShadows;

uint firstPatternParameter() { return cutout.firstPatternParameter; }
vec4 patternBounds() { return vec4(vec2(-3e38), vec2(3e38)); }
vec4 pixelFootprint() { return vec4(0); }  // light has no pixels

void main() {
  // Both for all fragments.
  float opacity = cutOut(cutout.opacity * paintAt(inParameters).a, cutout.leastOpaque);
  if (!isInFlatShadow() || opacity == 0.0) discard;
  outShadows = 1u << draw.light;
}
