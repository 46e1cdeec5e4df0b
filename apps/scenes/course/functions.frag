// SPDX-License-Identifier: Apache-2.0
// The curves of built-in functions, for x from -2 to 2: abs, sign, ceil, fract, mod, clamp, step, smoothstep, mix. Each in a
// cell of its own.
varying vec2 place;
float curve(in int cell, in float x) {
  if (cell == 0) return abs(x);
  if (cell == 1) return sign(x);
  if (cell == 2) return ceil(x);
  if (cell == 3) return fract(x);
  if (cell == 4) return mod(x, 0.75);
  if (cell == 5) return clamp(x, -0.5, 1.0);
  if (cell == 6) return step(0.5, x);
  if (cell == 7) return smoothstep(-1.0, 1.0, x);
  return mix(-1.0, 1.0, 0.25 * x + 0.5);
}
void main() {
  vec2 board = 3.0 * place, at = 4.0 * (fract(board) - 0.5);
  int cell = int(clamp(floor(board.x), 0.0, 2.0)) + 3 * int(clamp(floor(board.y), 0.0, 2.0));
  float below = smoothstep(-0.02, 0.02, curve(cell, at.x) - at.y);
  float axes = 1.0 - smoothstep(0.01, 0.03, min(abs(at.x), abs(at.y)));
  float frame = smoothstep(1.9, 1.94, max(abs(at.x), abs(at.y)));
  vec3 color = mix(vec3(0.8, 0.79, 0.74), vec3(0.15, 0.33, 0.6), below);
  color = mix(color, vec3(0.03), 0.6 * axes);
  gl_FragColor = vec4(mix(color, vec3(0.1), frame), 1.0);
}
