// SPDX-License-Identifier: Apache-2.0
// What is discarded is not there: a sieve of round holes, through which one sees its other side.
#version 120

uniform vec2 holes = vec2(24.0, 12.0);  // @slider 1 60
uniform float radius = 0.35;            // @slider 0 0.7

void main() {
  vec2 place = fract(holes * gl_TexCoord[0].st) - 0.5;
  if (length(place) < radius) discard;
  gl_FragColor = gl_Color;
}
