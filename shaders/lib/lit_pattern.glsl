// SPDX-License-Identifier: Apache-2.0
// The light on a point of a material with a pattern, or with a shader.
#extension GL_GOOGLE_include_directive : require
#ifdef LUXO_SHADER
#include "lib/lit_shader.glsl"
#else
#include "lib/found.glsl"
#include "lib/pattern.glsl"
#ifdef LUXO_MAPS
#include "lib/maps.glsl"
#endif
#ifdef LUXO_LESSON
#include "lib/lesson.glsl"
#endif

vec3 lit(Found found) {
  Material material = foundMaterial();
  material.diffuse = patternAt(found.parameters);
  if ((material.flags & kPatternAmbient) != 0) material.ambient *= material.diffuse;
#if defined(LUXO_LESSON) && defined(LUXO_SPECULAR_MAP)
  material.shininess = mappedExponent(found.parameters);
#elif defined(LUXO_SPECULAR_MAP)
  material.specular = mappedSpecular(material.specular, found.parameters);
#endif
#ifdef LUXO_NORMAL_MAP
  horizonNormal = found.normal;
  found.normal = bentNormal(found.normal, found.parameters);
#endif
#if defined(LUXO_LESSON) && defined(LUXO_GLOW_MAP)
  return lessonLight(material, wholeGlowAt(found.parameters), found);
#elif defined(LUXO_LESSON)
  return lessonLight(material, vec3(0), found);
#else
  vec3 light = illuminated(material, found.position, found.normal, found.viewer);
#ifdef LUXO_GLOW_MAP
  light += glowAt(found.parameters);
#endif
  return light;
#endif
}
#endif
