// SPDX-License-Identifier: Apache-2.0
// What a draw of the knot is told; as KnotData of plain_knot.cpp.
layout(push_constant) uniform Draw {
  mat4 clipFromWorld;
  vec4 eye, towardLight;  // towardLight: unit
};
