// SPDX-License-Identifier: Apache-2.0
// Local illumination: L = ka La + sum of visibility (kd max(N.L, 0) + ks max(N.H, 0)^n) Le, with Blinn's half vector
// H = (L + V) / |L + V|. A light at or below the horizon (N.L <= 0) adds nothing, its highlight included, unless the
// material asks for the lecture's ungated highlight. Positions relative to the eye, axes of the world.
#extension GL_GOOGLE_include_directive : require
#include "shared/scene_data.h"

// How many lights reach this draw: known when the pipeline is made, so that the loop unrolls and an unneeded light
// costs nothing. The lights themselves are data.
layout(constant_id = 0) const uint kPlainLights = 0;
layout(constant_id = 1) const uint kShadedLights = 0;

layout(scalar, set = 0, binding = kBindingLights) uniform Lights { LightSet lightSet; };

struct Material {
  vec3 ambient;
  vec3 diffuse;
  vec3 specular;
  float shininess;
  uint flags;
};

// x^n for 0 <= x <= 1 with 0^0 = 1, which pow leaves undefined.
float highlight(float x, float n) { return n == 0.0 ? 1.0 : x > 0.0 ? exp2(n * log2(x)) : 0.0; }

// n, v: unit. A point that coincides with the light gets nothing from it.
vec3 reflected(Material material, LightData light, vec3 position, vec3 n, vec3 v) {
  vec3 toLight = light.position.xyz - position * light.position.w;
  float squared = dot(toLight, toLight);
  if (squared == 0.0) return vec3(0);
  vec3 l = toLight * inversesqrt(squared);
  float cosine = dot(n, l);
  vec3 h = l + v;
  float hh = dot(h, h);
  float cosineHalf = hh > 0.0 ? max(dot(n, h) * inversesqrt(hh), 0.0) : 0.0;
  bool shines = cosine > 0.0 || (material.flags & kLectureSpecular) != 0;
  vec3 reflectance = material.diffuse * max(cosine, 0.0) +
                     (shines ? material.specular * highlight(min(cosineHalf, 1.0), material.shininess) : vec3(0));
  return reflectance * light.radiance * (light.inverseSquare != 0 ? 1.0 / squared : 1.0);
}

// What a light in the focus of a paraboloid shade lights: all inside the paraboloid, whose points are nearer to the
// focus than to the directrix plane, and all that the rim lets through. No angle is ever computed.
bool litThroughShade(ShadeData shade, vec3 position) {
  vec3 q = position - shade.focus;
  float along = dot(q, shade.axis);
  float len = sqrt(dot(q, q));
  return len <= along + 2.0 * shade.focalLength || along >= shade.cosRim * len;
}

vec3 illuminated(Material material, vec3 position, vec3 n, vec3 v) {
  vec3 sum = material.ambient;
  for (uint i = 0; i < kPlainLights; ++i) sum += reflected(material, lightSet.lights[i], position, n, v);
  for (uint i = 0; i < kShadedLights; ++i) {
    bool isTheShade = (material.flags >> kShadeShift) == i + 1;
    vec3 light = reflected(material, lightSet.lights[kPlainLights + i], position, n, v);
    sum += isTheShade || litThroughShade(lightSet.shades[i], position) ? light : vec3(0);
  }
  return sum;
}
