// SPDX-License-Identifier: Apache-2.0
// The lesson's pixel: engine/scene/lesson.h says which, and has the same in double. Whoever includes this includes
// lib/lit_pattern.glsl's files, too.
#ifndef LUXO_LIB_LESSON_GLSL
#define LUXO_LIB_LESSON_GLSL

const float kLessonFloor = 20.0 / 255.0, kLessonDiffuse = 1.2, kLessonReflected = 0.6, kLessonInShadow = 0.3;

vec3 lessonCode(vec3 linear) {
  vec3 curve = 1.055 * exp2(log2(max(linear, 1e-6)) / 2.4) - 0.055;
  return mix(curve, 12.92 * linear, lessThanEqual(linear, vec3(0.0031308)));
}

vec3 lessonShown(vec3 code) {
  vec3 c = min(code, 1.0), curve = exp2(2.4 * log2((c + 0.055) / 1.055));
  return mix(curve, c / 12.92, lessThanEqual(c, vec3(0.04045)));
}

// `material.shininess` is the exponent.
vec3 lessonLight(Material material, vec3 glow, Found found) {
  vec3 ground = kLessonFloor + lessonCode(glow), color = lessonCode(material.diffuse), dark = lessonShown(ground);
  vec3 sum = LUXO_ADDS_LIGHT ? vec3(0) : dark;
  uint inShadow = lightsInShadow();
  for (uint i = 0; i < kPlainLights + kShadedLights; ++i) {
    LightData light = lightAt(i);
    vec3 toLight = light.position.xyz - found.position * light.position.w;
    float squared = dot(toLight, toLight), inverseDistance = inversesqrt(max(squared, kTiny));
    vec3 l = toLight * inverseDistance, n = found.normal;
    float cosine = dot(n, l), along = max(dot(2.0 * cosine * n - l, -view.forward.xyz), 0.0);
    float power = material.shininess;
    float reflected = along > 0.0 || power == 0.0 ? exp2(power * log2(max(along, kTiny))) : 0.0;
    vec3 visible = vec3(isReached(i, inShadow, material.flags, toLight) ? 1 : 0);
#ifdef LUXO_SHADOWS
    if (kTransmits) visible *= lightTransmittance();
#endif
    float arriving = light.inverseSquare != 0 ? min(inverseDistance * inverseDistance, kMaxAttenuation) : 1.0;
    arriving *= spotAttenuation(i, found.position, toLight);
    vec3 part = kLessonInShadow + (1.0 - kLessonInShadow) * visible;
    vec3 added = color * light.radiance * arriving * part * (kLessonDiffuse * max(cosine, 0.0) + kLessonReflected * reflected);
    sum += squared > 0.0 ? lessonShown(ground + added) - dark : vec3(0);
  }
  return sum;
}
#endif
