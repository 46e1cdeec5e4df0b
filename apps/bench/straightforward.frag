// SPDX-License-Identifier: Apache-2.0
// Ambient, diffuse and Blinn's highlight of two lights; the second shines only where the shade lets it.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "object_data.glsl"

layout(location = 0) in vec3 wNormal;
layout(location = 1) in vec3 wView;
layout(location = 2) in vec3 wLight[2];

layout(location = 0) out vec4 fragmentColor;

bool litByTheLamp() {
  float along = dot(-wLight[1], wShadeAxis), len = length(wLight[1]);
  return isShade != 0 || len <= along + 2 * focalLength || along >= cosRim * len;
}

void main() {
  vec3 N = normalize(wNormal);
  vec3 V = normalize(wView);
  if (dot(N, V) < 0) N = -N;
  vec3 color = ka * La;
  for (int i = 0; i < 2; ++i) {
    vec3 L = normalize(wLight[i]);
    vec3 H = normalize(L + V);
    float cost = max(dot(N, L), 0), cosd = max(dot(N, H), 0);
    if (cost > 0 && (i == 0 || litByTheLamp()))
      color += (kd * cost + ks * pow(cosd, shine)) * Le[i] / dot(wLight[i], wLight[i]);
  }
  fragmentColor = vec4(color, 1);
}
