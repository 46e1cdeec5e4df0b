// SPDX-License-Identifier: Apache-2.0
// A surface as a drawing: its diffuse colour at two levels, full where some light falls in at less than 60 degrees and
// half elsewhere, and a black line along its silhouette.
#include "lib/surface_fragment.glsl"

const float kBright = 0.5;        // N.L from which the colour is full
const float kShaded = 0.5;        // the level below
const float kOutlineWidth = 2.0;  // pixels

layout(location = 14) sample in vec3 inDetail;  // u, v where there is a pattern; (N.V) |N.V|

float gradientLength(float x) { return max(length(vec2(dFdx(x), dFdy(x))), 1e-30); }

// How much of a pixel lies where x > 0: an edge one pixel wide.
float coverage(float x) { return clamp(x / gradientLength(x) + 0.5, 0.0, 1.0); }

float brightness(vec3 n) {
  float bright = 0.0;
  for (uint i = 0; i < kPlainLights + kShadedLights; ++i) {
    LightData light = lightAt(i);
    vec3 toLight = light.position.xyz - inPosition * light.position.w;
    float squared = dot(toLight, toLight);
    float covered = coverage(dot(n, toLight) * inversesqrt(max(squared, kTiny)) - kBright);
    bool shines = any(greaterThan(light.radiance, vec3(0)));
    if (i >= kPlainLights) {
      uint shade = i - kPlainLights;
      shines = shines && (shadeOf(inNumbers.x) == shade + 1 || litThroughShade(shadeAt(shade), -toLight));
    }
    bright = max(bright, shines ? covered : 0.0);
  }
  return bright;
}

// To first order q / |grad q| is the distance from where q is 0, in pixels; along a silhouette (N.V)^2 makes it exact.
float outline() {
  float distancePx = abs(inDetail.z) / gradientLength(inDetail.z);
  return clamp(kOutlineWidth + 0.5 - distancePx, 0.0, 1.0);
}

vec2 foundParameters() { return vec2(0); }

vec4 drawnFragment(vec3 color) {
  vec3 n = fragmentNormal(towardViewer(inViewer, inPosition));
  return vec4(color * mix(kShaded, 1.0, brightness(n)) * (1.0 - outline()), inShininessOpacity.y);
}
