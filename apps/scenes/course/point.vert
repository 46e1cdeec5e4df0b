// SPDX-License-Identifier: Apache-2.0
// A point and its normal in eye space, for whatever fragment program lights it: this one belongs to several.
#version 120
varying vec3 position, normal;
void main() {
  position = vec3(gl_ModelViewMatrix * gl_Vertex);
  normal = gl_NormalMatrix * gl_Normal;
  gl_TexCoord[0] = gl_TextureMatrix[0] * gl_MultiTexCoord0;
  gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
}
