// SPDX-License-Identifier: Apache-2.0
// A pixel whose layers rays have found.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/around_place.glsl"

layout(location = kAttributeLayerPlace) in vec2 inPlace;  // of the sample in the target, pixels
// Of the points: the first, how many, and how many of meshes follow them; and groups of lights.
layout(location = kAttributeLayerRange) in uvec4 inRange;

layout(location = kLocationLayerRange) flat out uvec4 outRange;
layout(location = kLocationLayerGroup) flat out uint outGroup;  // whose shadows they tell

void main() {
  outRange = inRange;
  outGroup = gl_InstanceIndex;
  gl_Position = aroundPlace(inPlace, 0.0);
}
