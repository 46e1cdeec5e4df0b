// SPDX-License-Identifier: Apache-2.0
// A pixel whose layers rays have found.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/around_place.glsl"

layout(location = 0) in vec2 inPlace;   // of the sample in the target, pixels
layout(location = 1) in uvec3 inRange;  // of the points: the first, and how many; groups of lights

layout(location = 0) flat out uvec4 outRange;  // and of which group their shadows are

void main() {
  outRange = uvec4(inRange, gl_InstanceIndex);
  gl_Position = aroundPlace(inPlace, 0.0);
}
