// SPDX-License-Identifier: Apache-2.0
// The whole target, for the light on what was found, with the lights that its fragments read often.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/light_counts.glsl"
#include "lib/lights.glsl"
#include "lib/viewed_target.glsl"

layout(location = 8) flat out vec4 outLights[2 * kCarriedLights];   // position; radiance, whether inverse-square
layout(location = 12) flat out vec4 outShades[2 * kCarriedShades];  // axis, cosine of the rim; reach

void main() {
  viewTarget();
  for (uint i = 0; i < kCarriedLights; ++i) {
    outLights[2 * i] = lightSet.lights[i].position;
    outLights[2 * i + 1] = vec4(lightSet.lights[i].radiance, lightSet.lights[i].inverseSquare);
  }
  for (uint i = 0; i < kCarriedShades; ++i) {
    outShades[2 * i] = vec4(lightSet.shades[i].axis, lightSet.shades[i].cosRim);
    outShades[2 * i + 1] = vec4(lightSet.shades[i].reach, 0, 0, 0);
  }
}
