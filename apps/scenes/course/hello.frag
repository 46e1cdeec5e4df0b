// SPDX-License-Identifier: Apache-2.0
// The least that a fragment program does: one colour, whatever the light.
void main() {
  gl_FragColor = vec4(0.0, 0.0, 1.0, 1.0);
}
