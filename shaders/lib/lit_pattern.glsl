// SPDX-License-Identifier: Apache-2.0
// The light on a point of a material with a pattern.
#extension GL_GOOGLE_include_directive : require
#include "lib/found.glsl"
#include "lib/pattern.glsl"

vec3 lit(Found found) {
  Material material = foundMaterial();
  material.diffuse = patternAt(found.parameters);
  if ((material.flags & kPatternAmbient) != 0) material.ambient *= material.diffuse;
  return illuminated(material, found.position, found.normal, found.viewer);
}
