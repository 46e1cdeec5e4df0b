// SPDX-License-Identifier: Apache-2.0
// Light per vertex where there are shadows, which no vertex can tell: of every light by itself what vertices receive of it is
// interpolated, and counts where the pixel's point sees that light. Of a light with an exact shadow none does that is turned
// away from it, by its own normal: a light below the horizon adds nothing, which interpolation would lead across.
#include "lib/again.glsl"
#include "lib/illumination.glsl"
#include "lib/lights.glsl"
#include "lib/scene.glsl"

layout(constant_id = kConstantFirstLight) const uint kFirstLight = 0;
layout(constant_id = kConstantExactShadows) const uint kExactShadows = 0;

layout(location = kLocationAgainReceived) sample in vec4 inReceived[kVertexLights];  // diffuse, highlight of the front; of the back
layout(location = kLocationAgainNumbers) flat in uvec3 inNumbers;  // flags; the material's number; where its pattern's parameters start
layout(location = kLocationAgainAmbient) flat in vec3 inAmbient;
layout(location = kLocationAgainDiffuse) flat in vec3 inDiffuse;
layout(location = kLocationAgainSpecular) flat in vec3 inSpecular;
layout(location = kLocationAgainOpacity) flat in float inOpacity;
layout(location = kLocationDetail) sample in vec2 inParameters;

LightData lightAt(uint i) { return lightSet.lights[i]; }
ShadeData shadeAt(uint i) { return lightSet.shades[i]; }

bool isLastOfGroup() { return kFirstLight + kVertexLights >= kPlainLights + kShadedLights; }
vec3 together(vec3 light, vec3 more) { return light + more; }

#ifdef LUXO_SPECULAR_MAP
vec3 mappedSpecular(vec3 specular, vec2 parameters);
#endif
#ifdef LUXO_GLOW_MAP
vec3 glowAt(vec2 parameters);
#endif

bool isLit(uint i, vec3 toLight) {
  uint light = 1u << i;
  if ((kExactShadows & light) != 0 && (inNumbers.x & kLectureSpecular) == 0 && dot(point.normal, toLight) <= 0.0) return false;
  return isReached(i, shadowsOfPoint(), inNumbers.x, toLight);
}

vec3 interpolatedLight(vec3 diffuse) {
  vec3 sum = kAddsLight ? vec3(0) : inAmbient * ((inNumbers.x & kPatternAmbient) != 0 ? diffuse : vec3(1));
#ifdef LUXO_GLOW_MAP
  sum += glowAt(inParameters);
#endif
  vec3 specular = inSpecular;
#ifdef LUXO_SPECULAR_MAP
  specular = mappedSpecular(specular, inParameters);
#endif
  for (uint k = 0; k < kVertexLights; ++k) {
    uint i = kFirstLight + k;
    if (i >= kPlainLights + kShadedLights) break;
    LightData light = lightAt(i);
    vec2 received = gl_FrontFacing ? inReceived[k].xy : inReceived[k].zw;
    vec3 reflection = (diffuse * received.x + specular * received.y) * light.radiance * throughToPoint();
    sum += isLit(i, light.position.xyz - point.position * light.position.w) ? reflection : vec3(0);
  }
  return sum;
}

void lightBetweenVertices(vec4 paint) {
  if (!findPoint(inNumbers.y)) discard;
  lightPoint(interpolatedLight(paint.rgb), paint);
}
