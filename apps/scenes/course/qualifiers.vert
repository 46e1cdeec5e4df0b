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
  split(turns * (uv.x + uv.y) + 0.25 * time, whole, part);
  vec3 color = 0.5 + 0.5 * cos(6.2831853 * (part + vec3(0.0, 0.33, 0.67)));
  soften(color);
  shown = vec4(color, 1.0);
  gl_Position = ftransform();
}
