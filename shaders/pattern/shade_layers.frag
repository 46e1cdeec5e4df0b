// SPDX-License-Identifier: Apache-2.0
// The light on what is seen through, on a pattern.
#version 460
#extension GL_GOOGLE_include_directive : require
#define LUXO_SHADOWS
#include "lib/shade_layers.glsl"
#include "lib/cutoff.glsl"
#include "lib/lit_pattern.glsl"

uint firstPatternParameter() { return material.firstPatternParameter; }
vec4 patternBounds() { return vec4(vec2(-3e38), vec2(3e38)); }  // what was found is within them

#ifdef LUXO_MAP_OPACITY
// Where floats do not tell whether there is a hole rays do, and have, of what they find.
float keptOf(float opacity, vec2 parameters) {
  if (material.leastOpaque == 0.0) return opacity;
  bool isFound = !isBesideRays(numberHere);
  if (isFound && (numberHere & kLayerByRay) != 0) return (numberHere & kLayerHole) != 0 ? 0.0 : 1.0;
  if (isFound && abs(opacity - material.leastOpaque) <= roundingOfAlpha(0, parameters)) doubtLayers();
  return cutOut(opacity, material.leastOpaque);
}
#else
float keptOf(float opacity, vec2 parameters) { return opacity; }
#endif

vec4 paintOf(Found found) {
#ifdef LUXO_SHADER
  vec3 tint = (material.blend & kBlendMode) == kBlendMultiply ? paintAt(found.parameters).rgb : material.diffuse;
  return vec4(tint, material.opacity * litOpacity);
#else
  vec4 paint = paintAt(found.parameters);
  return vec4(paint.rgb, keptOf(material.opacity * paint.a, found.parameters));
#endif
}

void main() { shadeLayers(); }
