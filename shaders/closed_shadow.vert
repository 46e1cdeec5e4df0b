// SPDX-License-Identifier: Apache-2.0
// The whole target, for some casters of one light that are known as equations.
#version 460
#extension GL_GOOGLE_include_directive : require
#define LUXO_VERTEX
#include "lib/closed_interface.glsl"
#include "lib/scene.glsl"

void main() {
  varyingPlace = vec3[](view.placeMiddle, view.placeRight, view.placeDown);
  varyingRay = vec3[](view.rayMiddle, view.rayRight, view.rayDown);
  varyingMiddle = vec4(view.middle, view.viewer.w, view.forward.w);
  varyingLightRelative = closedCasters[gl_InstanceIndex].lightRelative;
  for (int i = 0; i < kMaxClosedCasters; ++i)
    tellCaster(i, closedCasters[gl_InstanceIndex + min(i, int(kClosedCasters) - 1)]);
  // As far as can be: by the depth test no fragment is where nothing was found.
  gl_Position = vec4(gl_VertexIndex == 1 ? 3 : -1, gl_VertexIndex == 2 ? 3 : -1, 0, 1);
}
