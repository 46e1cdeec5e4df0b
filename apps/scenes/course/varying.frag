// SPDX-License-Identifier: Apache-2.0
// A varying of one's own as a colour.
varying vec4 shown;
void main() {
  gl_FragColor = shown;
}
