// SPDX-License-Identifier: Apache-2.0
// Scalars, vectors, matrices, arrays, structures; constructors; components as .xyzw, .rgba, .stpq; swizzles on both sides
// of an assignment. One cell of the board for each rule: green where it holds.
#version 120
struct Pair { vec2 first; float second[2]; };
varying vec2 place;
void main() {
  vec2 v2 = vec2(1.0, 2.0);
  vec3 v3 = vec3(0.0, 0.0, 1.0);
  vec4 v4 = vec4(1.0);
  bool holds[16];
  for (int i = 0; i < 16; ++i) holds[i] = false;
  holds[0] = v4 == vec4(1.0, 1.0, 1.0, 1.0);
  v4 = vec4(v2, v2);
  holds[1] = v4 == vec4(1.0, 2.0, 1.0, 2.0);
  v4 = vec4(v3, 1.0);
  holds[2] = v4.z == 1.0 && v4.w == 1.0;
  v2 = vec2(v4);  // the first components
  holds[3] = v2 == vec2(0.0);
  float f = 3.7;
  int i = int(f);
  holds[4] = i == 3 && float(i) == 3.0;
  v4 = vec4(1.0, 2.0, 3.0, 4.0);
  v4.wx = vec2(7.0, 8.0);
  holds[5] = v4 == vec4(8.0, 2.0, 3.0, 7.0);
  v4.yz = vec2(5.0);
  holds[6] = v4 == vec4(8.0, 5.0, 5.0, 7.0);
  holds[7] = v4.wzyx == vec4(7.0, 5.0, 5.0, 8.0) && v4.xxx == vec3(8.0);
  holds[8] = v4.r == v4.x && v4.s == v4[0] && v4.stp == v4.rgb;
  mat2 m = mat2(1.0, 2.0, 3.0, 4.0);  // columns
  holds[9] = m[1] == vec2(3.0, 4.0) && m[1][0] == 3.0;
  holds[10] = m * vec2(1.0, 0.0) == vec2(1.0, 2.0) && vec2(1.0, 0.0) * m == vec2(1.0, 3.0);
  holds[11] = mat4(1.0)[2] == vec4(0.0, 0.0, 1.0, 0.0);
  holds[12] = mat3(mat4(2.0))[1] == vec3(0.0, 2.0, 0.0);
  Pair pair;
  pair.first = vec2(1.0);
  pair.second[1] = 4.0;
  holds[13] = pair.first.y + pair.second[1] == 5.0;
  bvec3 less = lessThan(vec3(1.0, 2.0, 3.0), vec3(2.0));
  holds[14] = any(less) && !all(less) && less == bvec3(true, false, false);
  holds[15] = true ^^ false;
  vec2 board = 4.0 * place, inside = fract(board) - 0.5;
  int cell = int(clamp(floor(board.x), 0.0, 3.0)) + 4 * int(clamp(floor(board.y), 0.0, 3.0));
  float disc = 1.0 - smoothstep(0.36, 0.38, length(inside));
  vec3 color = holds[cell] ? vec3(0.1, 0.55, 0.2) : vec3(0.8, 0.05, 0.05);
  gl_FragColor = vec4(mix(vec3(0.75, 0.73, 0.68), color, disc), 1.0);
}
