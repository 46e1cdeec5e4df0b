// SPDX-License-Identifier: Apache-2.0
// The spheres of spheres.frag as Shadertoy has pictures: without any surface.
#include "spheres.glsl"

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
  vec2 at = (fragCoord - 0.5 * iResolution.xy) / iResolution.y;
  vec3 way = normalize(vec3(at, -1.6) + vec3(0.0, -0.12, 0.0));
  vec3 color = traced(vec3(0.0, 1.5, 3.0), way, Sun(normalize(vec3(0.6, 0.8, 0.4)), vec3(0.9), vec3(0.2)));
  fragColor = vec4(pow(color, vec3(1.0 / 2.2)), 1.0);
}
