// SPDX-License-Identifier: Apache-2.0
// Phong shading with luxo's usual material and ambient light, and one light far away.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "knot_data.glsl"

layout(location = 0) in vec3 inPosition;
layout(location = 1) in vec3 inNormal;
layout(location = 0) out vec4 outColor;

void main() {
  const float kDiffuse = 0.7, kSpecular = 0.2, kShininess = 30.0, kAmbient = 0.1;
  vec3 normal = normalize(inNormal), viewer = normalize(eye.xyz - inPosition);
  float cosine = dot(normal, towardLight.xyz), light = kAmbient * kDiffuse;
  if (cosine > 0.0)
    light += kDiffuse * cosine + kSpecular * pow(max(dot(normal, normalize(towardLight.xyz + viewer)), 0.0), kShininess);
  outColor = vec4(vec3(light), 1);
}
