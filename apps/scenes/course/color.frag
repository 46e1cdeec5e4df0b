// SPDX-License-Identifier: Apache-2.0
// What the vertex program made of the light, as it comes. Without a vertex program gl_Color is the light that luxo's own
// materials have: the fixed functionality.
#version 120
void main() {
  gl_FragColor = gl_Color;
}
