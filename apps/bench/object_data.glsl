// SPDX-License-Identifier: Apache-2.0
// Everything about one object, set anew for each before it is drawn. straightforward.cpp has the same struct.
#extension GL_EXT_scalar_block_layout : require

layout(scalar, set = 0, binding = 0) uniform ObjectData {
  mat4 MVP, M, Minv;
  vec3 wEye;
  vec4 wLiPos[2];  // the fixed light, the light in the focus of the shade
  vec3 Le[2];
  vec3 La;
  vec3 ka, kd, ks;
  float shine;
  vec3 wShadeAxis;
  float cosRim, focalLength;
  uint isShade;
};
