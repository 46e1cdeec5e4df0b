// SPDX-License-Identifier: Apache-2.0
// Moves the vertices of a flat mesh: two waves run over it. Where a place has moved to, and which way the water faces
// there, both follow from the place at rest, so that each pixel has them exactly.
#version 120

uniform float time;
uniform float height = 0.07;  // @slider 0 0.2

varying vec3 normal, eye;

void main() {
  vec2 first = vec2(4.2, 1.9), second = vec2(-2.6, 6.3);
  float a = dot(first, gl_Vertex.xz) - 2.2 * time, b = dot(second, gl_Vertex.xz) - 3.1 * time;
  vec3 place = gl_Vertex.xyz + vec3(0.0, height * (sin(a) + 0.5 * sin(b)), 0.0);
  vec2 slope = height * (cos(a) * first + 0.5 * cos(b) * second);
  normal = gl_NormalMatrix * vec3(-slope.x, 1.0, -slope.y);
  eye = (gl_ModelViewMatrix * vec4(place, 1.0)).xyz;
  gl_Position = gl_ModelViewProjectionMatrix * vec4(place, 1.0);
}
