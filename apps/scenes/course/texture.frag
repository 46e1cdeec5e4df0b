// SPDX-License-Identifier: Apache-2.0
// A map of the material, twice over, under its light. A sampler's value is the number of a map, as it was that of a
// texture unit: 0 is the colours', 1 the highlights', 2 the glow's.
#version 120
#include "light.glsl"
varying vec3 position, normal;
uniform sampler2D colors;
uniform vec2 tiles = vec2(1.0, 1.0);  // @slider 1 8
void main() {
  vec4 texel = texture2D(colors, tiles * gl_TexCoord[0].st);
  vec4 sum = gl_FrontLightModelProduct.sceneColor;
  for (int i = 0; i < gl_MaxLights; ++i) sum += fromLight(i, normalize(normal), position);
  gl_FragColor = sum * texel;
}
