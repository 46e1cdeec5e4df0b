// SPDX-License-Identifier: Apache-2.0
// A surface as a drawing: its diffuse colour at two levels, full where some light that reaches it falls in at less than 60
// degrees and half elsewhere, with an edge one pixel wide, and a black line along its silhouette. Where only a part of a
// light gets through to it, that part of the cosine counts, in each colour.
#include "lib/surface_fragment.glsl"

const float kBright = 0.5;        // N.L from which the colour is full
const float kShaded = 0.5;        // the level below
const float kOutlineWidth = 2.0;  // pixels

layout(location = 14) sample in vec3 inDetail;  // u, v where there is a pattern; (N.V) |N.V|

float gradientLength(float x) { return max(length(vec2(dFdx(x), dFdy(x))), 1e-30); }

#ifndef LUXO_LIB_AGAIN_GLSL
bool reachesPoint(uint light) { return true; }
vec3 throughToPoint() { return vec3(1); }
#endif

// How much of a pixel is where the cosine of light's angle, times what gets through of it, is above kBright: of each colour.
vec3 covered(float cosine, vec3 through) {
  return clamp((cosine * through - kBright) / max(gradientLength(cosine) * through, vec3(1e-30)) + 0.5, 0.0, 1.0);
}

vec3 brightness(vec3 n) {
  vec3 bright = vec3(0);
  for (uint i = 0; i < kPlainLights + kShadedLights; ++i) {
    LightData light = lightAt(i);
    vec3 toLight = light.position.xyz - inPosition * light.position.w;
    float squared = dot(toLight, toLight);
    vec3 covers = covered(dot(n, toLight) * inversesqrt(max(squared, kTiny)), throughToPoint());
    bool shines = any(greaterThan(light.radiance, vec3(0))) && reachesPoint(i);
    if (i >= kPlainLights) {
      uint shade = i - kPlainLights;
      shines = shines && (shadeOf(inNumbers.x) == shade + 1 || litThroughShade(shadeAt(shade), -toLight));
    }
    bright = max(bright, shines ? covers : vec3(0));
  }
  return bright;
}

// To first order q / |grad q| is the distance from where q is 0, in pixels; along a silhouette (N.V)^2 makes it exact.
float outline() {
  float distancePx = abs(inDetail.z) / gradientLength(inDetail.z);
  return clamp(kOutlineWidth + 0.5 - distancePx, 0.0, 1.0);
}

vec2 foundParameters() { return vec2(0); }

vec3 drawn(vec3 color) {
  vec3 n = fragmentNormal(towardViewer(inViewer, inPosition));
  return color * mix(vec3(kShaded), vec3(1), brightness(n)) * (1.0 - outline());
}

#ifdef LUXO_LIB_AGAIN_GLSL
// What more lights make of it is never darker.
vec3 together(vec3 light, vec3 more) { return max(light, more); }
bool isLastOfGroup() { return true; }

void drawAgain(vec4 paint, vec4 bounds) {
  bool isThere = findPoint(inNumbers.y, clamp(inDetail.xy, bounds.xy, bounds.zw), bounds);
  vec3 color = drawn(paint.rgb);  // before any fragment ends: it asks for derivatives
  if (!isThere) discard;
  lightPoint(color, paint);
}
#endif
