// SPDX-License-Identifier: Apache-2.0
// The whole target, for the depth map of a light.
#version 460
#extension GL_GOOGLE_include_directive : require
#define LUXO_VERTEX
#include "lib/light_map_interface.glsl"
#include "lib/scene.glsl"

void main() {
  LightMap map = lightMaps[gl_InstanceIndex];
  LightMapFace face = map.faces[0];
  varyingPlace = vec3[](view.placeMiddle, view.placeRight, view.placeDown);
  varyingRay = vec3[](view.rayMiddle, view.rayRight, view.rayDown);
  varyingMiddle = view.middle;
  varyingFace = vec3[](face.right, face.down, face.forward, face.origin);
  varyingLight = map.light;
  varyingTexel = vec4(map.texel, 0.5 * float(map.size), map.depthOfBuffer);
  varyingBias = vec4(map.bias, map.slopeBias, map.normalOffset, map.radius);
  varyingMap = uvec4(map.faceCount, map.pcf, map.receiverPlane, gl_InstanceIndex);
  // As far as can be: by the depth test no fragment is where nothing was found.
  gl_Position = vec4(gl_VertexIndex == 1 ? 3 : -1, gl_VertexIndex == 2 ? 3 : -1, 0, 1);
}
