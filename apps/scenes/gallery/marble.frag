// SPDX-License-Identifier: Apache-2.0
// Marble: veins where a sine of the place is bent by turbulence (K. Perlin, "An image synthesizer", SIGGRAPH 1985). A solid
// texture: the surface is cut from a block.
#include "noise.glsl"

uniform vec3 stone = vec3(0.82, 0.80, 0.76), vein = vec3(0.14, 0.13, 0.17);  // @color
uniform float scale = 1.6, bend = 7.0;
uniform int octaves = 6;  // @slider 1 12

vec4 material(Point p) {
  vec3 place = scale * p.object;
  float wave = 0.5 + 0.5 * sin(3.0 * place.y + bend * turbulence(place, octaves));
  return vec4(blinnPhong(mix(vein, stone, pow(wave, 0.6)), vec3(0.35), 90.0), 1.0);
}
