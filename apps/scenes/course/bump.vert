// SPDX-License-Identifier: Apache-2.0
// The frame of the surface: an attribute of the vertex that the language has no name for.
#version 120
attribute vec3 tangent, bitangent;
varying vec3 position;
varying mat3 frame;
varying vec2 uv;
void main() {
  position = vec3(gl_ModelViewMatrix * gl_Vertex);
  mat3 turn = mat3(gl_ModelViewMatrix[0].xyz, gl_ModelViewMatrix[1].xyz, gl_ModelViewMatrix[2].xyz);
  frame = mat3(turn * tangent, turn * bitangent, gl_NormalMatrix * gl_Normal);
  uv = gl_MultiTexCoord0.st;
  gl_Position = ftransform();
}
