// SPDX-License-Identifier: Apache-2.0
// Light in the fragment, from the position and the normal that the vertex program hands over.
#version 120
#include "light.glsl"
varying vec3 position, normal;
void main() {
  vec4 sum = gl_FrontLightModelProduct.sceneColor;
  for (int i = 0; i < gl_MaxLights; ++i) sum += fromLight(i, normalize(normal), position);
  gl_FragColor = sum;
}
