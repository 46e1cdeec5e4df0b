// SPDX-License-Identifier: Apache-2.0
// What a pattern or a map makes of a caster of a planar shadow, at its fragment.
#extension GL_GOOGLE_include_directive : require
#include "lib/flat_shadow.glsl"
#include "lib/cutoff.glsl"
#include "lib/pattern.glsl"

layout(location = kLocationFlatParameters) in vec2 inParameters;

uint firstPatternParameter() { return caster.firstPatternParameter; }
vec4 patternBounds() { return vec4(vec2(-3e38), vec2(3e38)); }
vec4 pixelFootprint() { return vec4(0); }  // light has no pixels

// Colour and opacity.
vec4 paintOfCaster() {
  vec4 paint = paintAt(inParameters);
  paint.a = cutOut(caster.opacity * paint.a, caster.leastOpaque);
  return paint;
}
