// SPDX-License-Identifier: Apache-2.0
// The surface's own coordinates.
attribute vec2 uv;
varying vec2 place;
void main() {
  place = uv;
  gl_Position = ftransform();
}
