// SPDX-License-Identifier: Apache-2.0
// A mirror of a sky that is a formula: reflect(), and back from eye space by the inverse matrix.
#version 120
varying vec3 position, normal;
uniform vec3 zenith = vec3(0.1, 0.3, 0.75), horizon = vec3(0.9, 0.85, 0.75), ground = vec3(0.25, 0.17, 0.1);
vec3 sky(const in vec3 d) {
  vec3 up = mix(horizon, zenith, pow(max(d.y, 0.0), 0.6));
  vec3 down = mix(horizon, ground, pow(clamp(-4.0 * d.y, 0.0, 1.0), 0.4));
  return d.y > 0.0 ? up : down;
}
void main() {
  vec3 r = reflect(normalize(position), normalize(normal));
  vec4 world = gl_ModelViewMatrixInverse * vec4(r, 0.0);
  gl_FragColor = vec4(sky(normalize(world.xyz)), 1.0);
}
