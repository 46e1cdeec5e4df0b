// SPDX-License-Identifier: Apache-2.0
// A vertex shader: one triangle over the whole target.
void main() { gl_Position = vec4(gl_VertexIndex == 1 ? 3 : -1, gl_VertexIndex == 2 ? 3 : -1, 0, 1); }
