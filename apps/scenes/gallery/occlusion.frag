// SPDX-License-Identifier: Apache-2.0
// Old bronze: green where little of the sky gets to, as rain washes the rest (G. Miller, "Efficient algorithms for local and
// global accessibility shading", SIGGRAPH 1994). How much gets there is the ambient occlusion that `render` asks for.
#include "noise.glsl"

uniform float sky = 0.5;                            // what a point gets that nothing is near to
uniform float age = 0.75;                           // up to this much of the sky it is green @slider 0 1
uniform float uneven = 0.5;                         // @slider 0 1
uniform vec3 bronze = vec3(0.30, 0.15, 0.055);       // @color
uniform vec3 verdigris = vec3(0.13, 0.36, 0.29);    // @color

vec4 material(Point p) {
  float open = ambientLight().g / max(sky, 1e-6) + uneven * (turbulence(2.5 * p.object, 6) - 0.4);
  float green = 1.0 - smoothstep(age - 0.1, age + 0.1, open);
  vec3 color = blinnPhong(mix(bronze, verdigris, green), vec3(mix(0.9, 0.02, green)), 60.0);
  return vec4(color, 1.0);
}
