// SPDX-License-Identifier: Apache-2.0
// The whole target, for the light on what was found, with the lights that its fragments read often.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/light_counts.glsl"
#include "lib/lights.glsl"
#include "lib/scene.glsl"

layout(location = 0) flat out vec4 outViewer;
layout(location = 1) flat out vec3 outPlace[3];  // middle, right, down, as in ViewData
layout(location = 4) flat out vec3 outRay[3];
layout(location = 7) flat out vec2 outMiddle;
layout(location = 8) flat out vec4 outLights[2 * kCarriedLights];   // position; radiance, whether inverse-square
layout(location = 12) flat out vec4 outShades[2 * kCarriedShades];  // axis, cosine of the rim; reach

void main() {
  outViewer = view.viewer;
  outPlace = vec3[](view.placeMiddle, view.placeRight, view.placeDown);
  outRay = vec3[](view.rayMiddle, view.rayRight, view.rayDown);
  outMiddle = view.middle;
  for (uint i = 0; i < kCarriedLights; ++i) {
    outLights[2 * i] = lightSet.lights[i].position;
    outLights[2 * i + 1] = vec4(lightSet.lights[i].radiance, lightSet.lights[i].inverseSquare);
  }
  for (uint i = 0; i < kCarriedShades; ++i) {
    outShades[2 * i] = vec4(lightSet.shades[i].axis, lightSet.shades[i].cosRim);
    outShades[2 * i + 1] = vec4(lightSet.shades[i].reach, 0, 0, 0);
  }
  // As far as can be: by the depth test no fragment is where nothing was found.
  gl_Position = vec4(gl_VertexIndex == 1 ? 3 : -1, gl_VertexIndex == 2 ? 3 : -1, 0, 1);
}
