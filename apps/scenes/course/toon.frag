// SPDX-License-Identifier: Apache-2.0
// A few tones and a dark outline, instead of light that fades.
#version 120
varying vec3 position, normal;
uniform vec3 paint = vec3(0.85, 0.35, 0.1);  // @color
uniform int tones = 3;                       // @slider 2 6
uniform float outline = 0.28;                // @slider 0 0.6
void main() {
  vec3 n = normalize(normal), v = normalize(-position);
  vec3 to = normalize(gl_LightSource[0].position.xyz - gl_LightSource[0].position.w * position);
  float lit = gl_LightSource[0].diffuse.g > 0.0 ? max(dot(n, to), 0.0) : 0.0;
  float tone = (floor(lit * float(tones) * 0.999) + 1.0) / float(tones);
  float edge = smoothstep(outline, outline + 0.03, dot(n, v));
  float glint = step(0.99, dot(n, normalize(to + v))) * step(0.001, lit);
  gl_FragColor = vec4(mix(paint * tone, vec3(1.0), 0.8 * glint) * mix(0.05, 1.0, edge), 1.0);
}
