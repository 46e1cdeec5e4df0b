// SPDX-License-Identifier: Apache-2.0
// What a draw of shadows in closed form tells its fragments: the pixel's place, and up to kMaxClosedCasters casters; the same
// all over the target.
#ifndef LUXO_LIB_CLOSED_INTERFACE_GLSL
#define LUXO_LIB_CLOSED_INTERFACE_GLSL
#include "lib/place_interface.glsl"

const int kClosedNumbers = 10;  // of a caster, four at a time
layout(constant_id = kConstantClosedCasters) const uint kClosedCasters = 1;
layout(constant_id = kConstantClosedKind) const uint kClosedKind = kClosedQuadric;

layout(location = 7) flat LUXO_VARYING vec4 varyingLightRelative;
layout(location = 8) flat LUXO_VARYING vec4 varyingNumbers[kClosedNumbers * kMaxClosedCasters];
layout(location = 28) flat LUXO_VARYING uvec3 varyingClosed[kMaxClosedCasters];  // light_, flags, material

#ifdef LUXO_VERTEX
layout(scalar, set = kSetShadow, binding = kBindingClosedCasters) readonly buffer ClosedCasters { ClosedCaster closedCasters[]; };

void tellCaster(int i, ClosedCaster caster) {
  int first = kClosedNumbers * i;
  for (int row = 0; row < 3; ++row) varyingNumbers[first + row] = caster.unitFromRelative[row];
  varyingNumbers[first + 3] = caster.light;
  varyingNumbers[first + 4] = vec4(caster.squares, caster.halfY);
  varyingNumbers[first + 5] = vec4(caster.constant, caster.tube, caster.atLight, caster.offPerPixel);
  varyingNumbers[first + 6] = vec4(caster.lowest, 0);
  varyingNumbers[first + 7] = vec4(caster.highest, 0);
  varyingNumbers[first + 8] = vec4(caster.rounding, 0);
  varyingNumbers[first + 9] = vec4(caster.roundingPerMetre, 0);
  varyingClosed[i] = uvec3(caster.light_, caster.flags, caster.material);
}
#else
ClosedCaster toldCaster(int i) {
  int first = kClosedNumbers * i;
  vec4 squares = varyingNumbers[first + 4], constant = varyingNumbers[first + 5];
  uvec3 caster = varyingClosed[i];
  return ClosedCaster(vec4[](varyingNumbers[first], varyingNumbers[first + 1], varyingNumbers[first + 2]),
                      varyingNumbers[first + 3], varyingLightRelative, squares.xyz, squares.w, constant.x, constant.y,
                      constant.z, varyingNumbers[first + 6].xyz, varyingNumbers[first + 7].xyz, varyingNumbers[first + 8].xyz,
                      varyingNumbers[first + 9].xyz, constant.w, caster.x, caster.y, caster.z);
}
#endif
#endif
