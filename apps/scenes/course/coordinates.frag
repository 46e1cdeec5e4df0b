// SPDX-License-Identifier: Apache-2.0
// Where the fragment is in the picture, from its bottom left, in pixels: a screen of dots through which one looks at the
// light that the scene's own materials have (gl_Color, without a vertex program).
#version 120
uniform float period = 9.0;  // @slider 3 40
void main() {
  vec2 cell = fract(gl_FragCoord.xy / period) - 0.5;
  float bright = dot(gl_Color.rgb, vec3(0.3, 0.6, 0.1)), radius = 0.75 * sqrt(clamp(1.0 - bright, 0.0, 1.0));
  float ink = 1.0 - smoothstep(radius - 0.12, radius + 0.12, length(cell));
  gl_FragColor = vec4(mix(vec3(0.9, 0.87, 0.78), vec3(0.06, 0.05, 0.12), ink), 1.0);
}
