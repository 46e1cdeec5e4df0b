// SPDX-License-Identifier: Apache-2.0
// The whole target, for one caster of one light.
#version 460
#extension GL_GOOGLE_include_directive : require
#define LUXO_VERTEX
#include "lib/scene.glsl"
#include "lib/shadow_interface.glsl"

void main() {
  ShadowCaster caster = casters[gl_InstanceIndex];
  varyingPlace = vec3[](view.placeMiddle, view.placeRight, view.placeDown);
  varyingRay = vec3[](view.rayMiddle, view.rayRight, view.rayDown);
  varyingMiddle = vec4(view.middle, view.viewer.w, view.forward.w);
  for (int i = 0; i < 3; ++i) {
    mat3 grid = caster.gridFromRelative, object = caster.objectFromRelative;
    varyingGrid[i] = vec4(grid[0][i], grid[1][i], grid[2][i], caster.gridOrigin[i]);
    varyingObject[i] = vec4(object[0][i], object[1][i], object[2][i], caster.objectOrigin[i]);
  }
  varyingLightObject = caster.lightObject;
  varyingLightRelative = caster.lightRelative;
  varyingRounding = vec4(caster.rounding, caster.roundingPerMetre, caster.margin, caster.pixel);
  varyingFirst = uvec4(caster.firstEntry, caster.firstCell, caster.firstParameter, caster.parameters);
  varyingCaster = uvec4(gl_InstanceIndex, caster.light, caster.flags, caster.gridSize);
  varyingFaces = caster.faces;
  varyingPlane = caster.plane;
  varyingMaterial = uvec2(caster.material, caster.firstPatternParameter);
  varyingPaint = vec4(caster.diffuse, caster.opacity);
  varyingOff = vec2(caster.offPixels, caster.leastOpaque);
  for (int i = 0; i < 2; ++i)
    varyingFirstTexels[i] = uvec3(caster.firstTexel[i], caster.firstTexel[2 + i], caster.firstTexel[4 + i]);
  // As far as can be: by the depth test no fragment is where nothing was found.
  gl_Position = vec4(gl_VertexIndex == 1 ? 3 : -1, gl_VertexIndex == 2 ? 3 : -1, 0, 1);
}
