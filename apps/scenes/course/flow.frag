// SPDX-License-Identifier: Apache-2.0
// if and else, for, while, do, continue, break, return: how soon z * z + c leaves for good.
varying vec2 place;
uniform vec2 middle = vec2(-0.55, 0.0);
uniform float wide = 2.7;  // @slider 0.001 4
float leaves(in vec2 c) {
  vec2 z = vec2(0.0);
  for (int i = 0; i < 96; i++) {
    z = vec2(z.x * z.x - z.y * z.y, 2.0 * z.x * z.y) + c;
    if (dot(z, z) < 256.0) continue;
    return float(i) + 3.0 - log2(log2(dot(z, z)));
  }
  return -1.0;
}
void main() {
  float rounds = leaves(middle + wide * (place - 0.5)), shade = 0.0, step = 1.0;
  if (rounds < 0.0) {
    gl_FragColor = vec4(0.01, 0.01, 0.02, 1.0);
  } else {
    while (rounds > 0.0) {
      shade += step * min(rounds, 8.0) / 8.0;
      step *= 0.5;
      rounds -= 8.0;
      if (step < 0.01) break;
    }
    int k = 0;
    do { shade *= 0.98; k++; } while (k < 3);
    gl_FragColor = vec4(pow(vec3(0.5 * shade), vec3(3.2, 1.6, 0.9)), 1.0);
  }
}
