// SPDX-License-Identifier: Apache-2.0
// Spheres by tracing rays in a fragment program (T. Whitted 1980): what has this material is a window to them.
#include "spheres.glsl"

// Its first light is the sun: one that is far away.
vec4 material(Point p) {
  Sun sun = Sun(vec3(0.0, 1.0, 0.0), vec3(0.0), ambientLight());
  if (lightCount() > 0) sun = Sun(light(0).direction, light(0).radiance, ambientLight());
  return vec4(traced(p.position, -p.viewer, sun), 1.0);
}
