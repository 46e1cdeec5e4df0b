// SPDX-License-Identifier: Apache-2.0
// const, attribute, uniform, varying; parameters that go in, out, and both ways.
const float turns = 3.0;
attribute vec2 uv;
uniform float time;
varying vec4 shown;
void split(in float x, out float whole, out float part) {
  whole = floor(x);
  part = fract(x);
}
void soften(inout vec3 color) { color = color * color * (3.0 - 2.0 * color); }
void main() {
  float whole, part;
  split(2.0 * turns * length(uv - 0.5) - 0.25 * time, whole, part);
  vec3 color = mix(vec3(0.05, 0.2, 0.35), vec3(0.95, 0.75, 0.35), abs(2.0 * part - 1.0)) * (1.0 - 0.12 * abs(whole));
  soften(color);
  shown = vec4(color, 1.0);
  gl_Position = ftransform();
}
