// SPDX-License-Identifier: Apache-2.0
// The whole target, for the points of one mesh's surface.
#version 460
#extension GL_GOOGLE_include_directive : require
#define LUXO_VERTEX
#include "lib/mesh_place_interface.glsl"
#include "lib/scene.glsl"

void main() {
  MeshPlace of = meshPlaces[gl_InstanceIndex];
  varyingPlace = vec3[](view.placeMiddle, view.placeRight, view.placeDown);
  varyingRay = vec3[](view.rayMiddle, view.rayRight, view.rayDown);
  varyingMiddle = vec4(view.middle, view.viewer.w, view.forward.w);
  varyingRelative = vec3[](of.relativeFromObject[0], of.relativeFromObject[1], of.relativeFromObject[2], of.translation);
  varyingFirst = uvec4(0, of.firstPatch, of.firstParameter, of.parameters);
  varyingNode = uvec2(of.patches, of.material);
  // As far as can be: by the depth test no fragment is where nothing was found.
  gl_Position = vec4(gl_VertexIndex == 1 ? 3 : -1, gl_VertexIndex == 2 ? 3 : -1, 0, 1);
}
