// SPDX-License-Identifier: Apache-2.0
// Phong shading as the lecture has it: normal, view and light directions are interpolated.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "object_data.glsl"
#include "shared/bindings.h"

layout(location = kAttributePosition) in vec3 vtxPos;
layout(location = kAttributeNormal) in vec3 vtxNorm;
layout(location = kAttributeParameters) in vec2 vtxTex;

layout(location = 0) out vec3 wNormal;
layout(location = 1) out vec3 wView;
layout(location = 2) out vec3 wLight[2];

void main() {
  gl_Position = MVP * vec4(vtxPos, 1);
  vec4 wPos = M * vec4(vtxPos, 1);
  for (int i = 0; i < 2; ++i) wLight[i] = wLiPos[i].xyz * wPos.w - wPos.xyz * wLiPos[i].w;
  wView = wEye - wPos.xyz / wPos.w;
  wNormal = (vec4(vtxNorm, 0) * Minv).xyz;
}
