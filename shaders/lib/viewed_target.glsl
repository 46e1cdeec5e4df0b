// SPDX-License-Identifier: Apache-2.0
// A vertex of a triangle over the whole target, with what its fragments need to know of places in the view.
#include "lib/scene.glsl"

layout(location = kLocationTargetViewer) flat out vec4 outViewer;
layout(location = kLocationTargetPlace) flat out vec3 outPlace[3];  // middle, right, down, as in ViewData
layout(location = kLocationTargetRay) flat out vec3 outRay[3];
layout(location = kLocationTargetMiddle) flat out vec2 outMiddle;

void viewTarget() {
  outViewer = view.viewer;
  outPlace = vec3[](view.placeMiddle, view.placeRight, view.placeDown);
  outRay = vec3[](view.rayMiddle, view.rayRight, view.rayDown);
  outMiddle = view.middle;
  // As far as can be: by the depth test no fragment is where nothing was found.
  gl_Position = vec4(gl_VertexIndex == 1 ? 3 : -1, gl_VertexIndex == 2 ? 3 : -1, 0, 1);
}
