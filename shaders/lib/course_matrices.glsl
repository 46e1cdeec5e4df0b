// SPDX-License-Identifier: Apache-2.0
// What of the state of GLSL 1.20 (lib/course.glsl) follows from some of it.

// From those of model and view, of the projection, and from their inverses.
void luxoDeriveMatrices() {
  gL_ModelViewProjectionMatrix = gL_ProjectionMatrix * gL_ModelViewMatrix;
  gL_ModelViewProjectionMatrixInverse = gL_ModelViewMatrixInverse * gL_ProjectionMatrixInverse;
  gL_ModelViewMatrixTranspose = transpose(gL_ModelViewMatrix);
  gL_ProjectionMatrixTranspose = transpose(gL_ProjectionMatrix);
  gL_ModelViewProjectionMatrixTranspose = transpose(gL_ModelViewProjectionMatrix);
  gL_ModelViewMatrixInverseTranspose = transpose(gL_ModelViewMatrixInverse);
  gL_ProjectionMatrixInverseTranspose = transpose(gL_ProjectionMatrixInverse);
  gL_ModelViewProjectionMatrixInverseTranspose = transpose(gL_ModelViewProjectionMatrixInverse);
  for (int i = 0; i < gL_MaxTextureCoords; ++i) gL_TextureMatrix[i] = mat4(1);
  gL_NormalScale = 1.0;
  gL_DepthRange = gL_DepthRangeParameters(0.0, 1.0, 1.0);
}

void luxoLoadTexCoords(vec2 parameters) {
  vec4 uv = vec4(parameters, 0, 1);
  gL_MultiTexCoord0 = gL_MultiTexCoord1 = gL_MultiTexCoord2 = gL_MultiTexCoord3 = uv;
  gL_MultiTexCoord4 = gL_MultiTexCoord5 = gL_MultiTexCoord6 = gL_MultiTexCoord7 = uv;
  for (int i = 0; i < gL_MaxTextureCoords; ++i) gL_TexCoord[i] = uv;
}

// From those of the material.
void luxoLoadColors() {
  gL_SecondaryColor = gL_FrontSecondaryColor = gL_BackSecondaryColor = vec4(0, 0, 0, 1);
  gL_FrontColor = gL_BackColor = gL_Color = gL_FrontMaterial.diffuse;
}
