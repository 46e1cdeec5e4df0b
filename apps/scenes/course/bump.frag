// SPDX-License-Identifier: Apache-2.0
// Rows of round studs that are not there: only the normal is bent.
#version 120
#include "light.glsl"
varying vec3 position;
varying mat3 frame;
varying vec2 uv;
uniform vec2 studs = vec2(18.0, 9.0);  // @slider 1 40
uniform float height = 0.8;            // @slider 0 1.5
void main() {
  vec2 cell = 2.0 * fract(uv * studs) - 1.0;
  float r = dot(cell, cell);
  vec3 bent = r < 0.64 ? vec3(height * cell, sqrt(max(1.0 - height * height * r, 0.0))) : vec3(0.0, 0.0, 1.0);
  vec3 n = normalize(frame * bent);
  vec4 sum = gl_FrontLightModelProduct.sceneColor;
  for (int i = 0; i < gl_MaxLights; ++i) sum += fromLight(i, n, position);
  gl_FragColor = sum;
}
