// SPDX-License-Identifier: Apache-2.0
// What a material's maps beside that of its colour make of a point: engine/scene/normal_map.h has the same in double.
// Whoever includes this includes lib/pattern.glsl, too, and knows the point's frame.
#ifndef LUXO_LIB_MAPS_GLSL
#define LUXO_LIB_MAPS_GLSL
#include "lib/scene.glsl"

// Whether the light of the first group is there already, and with it what glows.
#ifndef LUXO_ADDS_LIGHT
#define LUXO_ADDS_LIGHT false
#endif

vec2 mapParameters(vec2 parameters) { return patternParametersAt(parameters); }

#ifdef LUXO_SPECULAR_MAP
vec3 mappedSpecular(vec3 specular, vec2 parameters) {
  return specular * texelOfMap(LUXO_SPECULAR_MAP, mapParameters(parameters));
}

// The byte that it is.
float mappedExponent(vec2 parameters) {
  return 255.0 * texelOfMap(LUXO_SPECULAR_MAP, mapParameters(parameters)).r;
}
#endif

#ifdef LUXO_GLOW_MAP
vec3 wholeGlowAt(vec2 parameters) {
  return tintOfMap(LUXO_GLOW_MAP) * texelOfMap(LUXO_GLOW_MAP, mapParameters(parameters));
}

vec3 glowAt(vec2 parameters) { return LUXO_ADDS_LIGHT ? vec3(0) : wholeGlowAt(parameters); }
#endif

#ifdef LUXO_NORMAL_MAP
vec3 bentNormal(vec3 normal, vec2 parameters) {
  vec3 v = normalFromTexel() * (2.0 * texelOfMap(LUXO_NORMAL_MAP, mapParameters(parameters)) - 1.0);
#ifdef LUXO_FRAMED
  vec4 frame = normalFrame();
  vec3 bent = unitOrZero(v.x * frame.xyz + v.y * frame.w * cross(normal, frame.xyz) + v.z * abs(frame.w) * normal);
#else
  vec3 bent = unitOrZero(dot(v, normal) < 0.0 ? -v : v);
#endif
  return dot(bent, bent) > 0.5 ? bent : normal;
}
#endif
#endif
