// SPDX-License-Identifier: Apache-2.0
// Local illumination: L = ka La + sum of visibility (kd max(N.L, 0) + ks max(N.H, 0)^n) Le, with Blinn's half vector
// H = (L + V) / |L + V|. A light at or below the horizon (N.L <= 0) adds nothing, its highlight included, unless the
// material asks for the lecture's ungated highlight. Positions as shared/scene_data.h has them.
#extension GL_GOOGLE_include_directive : require
#include "lib/light_counts.glsl"
#include "shared/scene_data.h"

// Which lights they are, the shaded ones last: the including shader says where it has them from.
LightData lightAt(uint i);
ShadeData shadeAt(uint i);
SpotData spotAt(uint i);  // of light i
#ifdef LUXO_SHADOWS
uint shadows();  // the lights, a bit each, that do not reach the point
vec3 lightTransmittance();  // how much of the only light gets through to it

layout(constant_id = kConstantTransmits) const bool kTransmits = false;
#endif

struct Material {
  vec3 ambient;
  vec3 diffuse;
  vec3 specular;
  float shininess;
  uint flags;
};

Material materialOf(MaterialData data) {
  return Material(data.ambient, data.diffuse, data.specular, data.shininess, data.flags);
}

// Stands for 0 under a root or a division: small enough to change no other number.
const float kTiny = 1e-37;

// An inverse-square light as near as 1e-15 metres gets no brighter: its product with any radiance is still a number.
const float kMaxAttenuation = 1e30;

// log2(1 - x) for x in 0..0.15, to 1e-8, all digits of small x included: by interpolation in Chebyshev's points.
float log2OfOneLess(float x) {
  return -x * (1.44269509 + x * (0.721330866 + x * (0.481774529 + x * (0.344806117 + x * 0.401511011))));
}

// cos^power of the angle between n (unit) and h, with 0^0 = 1, which pow leaves undefined. Where a highlight is bright the
// cosine is nearly 1, and the power magnifies what rounding leaves of it: there the sine tells.
float highlight(vec3 n, vec3 h, float power) {
  float perSquared = 1.0 / max(dot(h, h), kTiny), cosine = max(dot(n, h), 0.0);
  float cosineSquared = min(cosine * cosine * perSquared, 1.0);
  vec3 across = h - cosine * n;
  float logarithm = cosineSquared > 0.85 ? log2OfOneLess(dot(across, across) * perSquared)
                                         : log2(max(cosineSquared, kTiny));
  return cosineSquared > 0.0 || power == 0.0 ? exp2(0.5 * power * logarithm) : 0.0;
}

#ifdef LUXO_NORMAL_MAP
vec3 horizonNormal;  // of the surface itself: a light below its horizon adds nothing, however a map bends what n is
#endif

// n, v: unit. A point that coincides with the light gets nothing from it.
vec3 reflected(Material material, LightData light, vec3 toLight, vec3 n, vec3 v) {
  float squared = dot(toLight, toLight);
  float inverseDistance = inversesqrt(max(squared, kTiny));
  vec3 l = toLight * inverseDistance;
  float cosine = dot(n, l);
  vec3 h = l + v;
  bool shines = cosine > 0.0 || ((material.flags & kLectureSpecular) != 0 && squared > 0.0);
#ifdef LUXO_NORMAL_MAP
  if (dot(horizonNormal, l) <= 0.0 && (material.flags & kLectureSpecular) == 0) return vec3(0);
#endif
  vec3 reflectance = material.diffuse * max(cosine, 0.0) +
                     (shines ? material.specular * highlight(n, h, material.shininess) : vec3(0));
  return reflectance * light.radiance * (light.inverseSquare != 0 ? min(inverseDistance * inverseDistance, kMaxAttenuation) : 1.0);
}

// How much of light i goes from it to a point: 1, but of a spot what its cone has for the angle a there, by
// 1 - cos a = sin^2 a / (1 + cos a), which keeps what cosines lose of small angles.
float spotAttenuation(uint i, vec3 position, vec3 toLight) {
  if ((kSpots & 1u << i) == 0) return 1.0;
  SpotData spot = spotAt(i);
  float inverseDistance = inversesqrt(max(dot(toLight, toLight), kTiny));
  float cosine = -dot(toLight, spot.axis) * inverseDistance;
  if (cosine <= 0.0) return 0.0;  // no cone is wider
  vec3 from = position - spot.through, across = (from - dot(from, spot.axis) * spot.axis) * inverseDistance;
  float part = clamp((spot.rise - dot(across, across) / (1.0 + cosine)) * spot.perPenumbra, 0.0, 1.0);
  return part * part;
}

// What a light in the focus of a paraboloid shade lights: all inside the paraboloid, whose points are nearer to the
// focus than to the directrix plane, and all that the rim lets through. No angle is ever computed.
bool litThroughShade(ShadeData shade, vec3 fromFocus) {
  float along = dot(fromFocus, shade.axis);
  float len = sqrt(dot(fromFocus, fromFocus));
  return len <= along + shade.reach || along >= shade.cosRim * len;
}

// A bit for each light that a caster keeps from here.
uint lightsInShadow() {
#ifdef LUXO_SHADOWS
  return shadows();
#else
  return 0;
#endif
}

// Whether nothing keeps light i from a point of a material with these flags: no caster of the lights in `inShadow`, nor the
// shade that the lamp's bulb is in, which is convex and keeps it from none of its own points.
bool isReached(uint i, uint inShadow, uint materialFlags, vec3 toLight) {
  if ((inShadow & (1u << i)) != 0) return false;
  if (i < kPlainLights) return true;
  ShadeData shade = shadeAt(i - kPlainLights);
  return (materialFlags >> kShadeShift & 255) == shade.number || litThroughShade(shade, -toLight);
}

vec3 illuminated(Material material, vec3 position, vec3 n, vec3 v) {
  vec3 sum = material.ambient;
  uint inShadow = lightsInShadow();
  for (uint i = 0; i < kPlainLights + kShadedLights; ++i) {
    LightData light = lightAt(i);
    vec3 toLight = light.position.xyz - position * light.position.w;
    vec3 reflection = reflected(material, light, toLight, n, v) * spotAttenuation(i, position, toLight);
#ifdef LUXO_SHADOWS
    if (kTransmits) reflection *= lightTransmittance();
#endif
    sum += isReached(i, inShadow, material.flags, toLight) ? reflection : vec3(0);
  }
  return sum;
}
