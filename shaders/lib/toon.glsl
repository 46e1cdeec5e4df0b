// SPDX-License-Identifier: Apache-2.0
// A surface as a drawing: its diffuse colour at two levels, full where some light that reaches it falls in at less than 60
// degrees and half elsewhere, with an edge one pixel wide, and a black line along its silhouette. Where only a part of a
// light gets through to it, that part of the cosine counts, in each colour; or of a spot's within its cone.
#include "lib/surface_fragment.glsl"
#include "shared/truth.h"

layout(location = kLocationDetail) sample in vec3 inDetail;  // u, v where there is a pattern; (N.V) |N.V|

#ifdef LUXO_NORMAL_MAP
vec3 bentNormal(vec3 normal, vec2 parameters);
#endif
#ifdef LUXO_GLOW_MAP
vec3 glowAt(vec2 parameters);
#endif

float gradientLength(float x) { return max(length(vec2(dFdx(x), dFdy(x))), 1e-30); }

#ifndef LUXO_LIB_AGAIN_GLSL
uint shadowsOfPoint() { return 0; }
vec3 throughToPoint() { return vec3(1); }
#endif

// How much of a pixel is where the cosine of light's angle, times what gets through of it, is above kDrawnBright: of each
// colour; `gradient`: how the cosine changes from pixel to pixel.
vec3 covered(float cosine, float gradient, vec3 through) {
  return clamp((cosine * through - kDrawnBright) / max(gradient * through, vec3(1e-30)) + 0.5, 0.0, 1.0);
}

vec3 brightness(vec3 n) {
  vec3 bright = vec3(0);
  for (uint i = 0; i < kPlainLights + kShadedLights; ++i) {
    LightData light = lightAt(i);
    vec3 toLight = light.position.xyz - inPosition * light.position.w;
    float squared = dot(toLight, toLight);
    float perDistance = inversesqrt(max(squared, kTiny)) * spotAttenuation(i, inPosition, toLight);
    float cosine = dot(n, toLight) * perDistance;
#ifdef LUXO_NORMAL_MAP
    // Of the surface without its map: pixels beside a triangle may read nothing of this (Mesa 22.3's lavapipe).
    float gradient = gradientLength(dot(horizonNormal, toLight) * perDistance);
#else
    float gradient = gradientLength(cosine);
#endif
    vec3 covers = covered(cosine, gradient, throughToPoint());
    bool shines = any(greaterThan(light.radiance, vec3(0))) && isReached(i, shadowsOfPoint(), inNumbers.x, toLight);
#ifdef LUXO_NORMAL_MAP
    shines = shines && dot(horizonNormal, toLight) > 0.0;
#endif
    bright = max(bright, shines ? covers : vec3(0));
  }
  return bright;
}

// To first order q / |grad q| is the distance from where q is 0, in pixels; along a silhouette (N.V)^2 makes it exact.
float outline() {
  float distancePx = abs(inDetail.z) / gradientLength(inDetail.z);
  return clamp(kDrawnOutlinePx + 0.5 - distancePx, 0.0, 1.0);
}

vec2 foundParameters() { return vec2(0); }

vec3 drawn(vec3 color) {
  vec3 n = fragmentNormal(towardViewer(viewerOfDraw(), inPosition));
#ifdef LUXO_NORMAL_MAP
  horizonNormal = n;
  n = bentNormal(n, inDetail.xy);
#endif
  vec3 light = color * mix(vec3(kDrawnShaded), vec3(1), brightness(n));
#ifdef LUXO_GLOW_MAP
  light += glowAt(inDetail.xy);
#endif
  return light * (1.0 - outline());
}

#ifdef LUXO_LIB_AGAIN_GLSL
// What more lights make of it is never darker.
vec3 together(vec3 light, vec3 more) { return max(light, more); }
bool isLastOfGroup() { return true; }

void drawAgain(vec4 paint) {
  bool isThere = findPoint(inNumbers.y);
  vec3 color = drawn(paint.rgb);  // before any fragment ends: it asks for derivatives
  if (!isThere) discard;
  lightPoint(color, paint);
}
#endif
