// SPDX-License-Identifier: Apache-2.0
// The least that a vertex program does: the vertex goes where it would go without one.
void main() {
  gl_Position = ftransform();
}
