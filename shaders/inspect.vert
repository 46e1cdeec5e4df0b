// SPDX-License-Identifier: Apache-2.0
// Vertices for the views of geometry: position, normal, surface parameters, number of the node.
//
// Vertices are shared across a seam and at a pole, where one vertex has several u. Interpolation still gets the right
// parameters: a seam's vertices also carry their upper value, chosen per triangle by its column, and at a collapsed
// edge u is interpolated projectively with weight 0, so that only the other two corners count.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/scene.glsl"

layout(location = 0) in vec3 inPosition;
layout(location = 1) in vec3 inNormal;
layout(location = 2) in vec2 inParameters;

layout(location = 0) sample out vec3 outPosition;
layout(location = 1) sample out vec3 outNormal;
layout(location = 2) sample out vec4 outParameters;  // u weight, v, upper u weight, upper v
layout(location = 3) sample out float outWeight;
layout(location = 4) flat out vec2 outCorner;  // (u, v) of the triangle's own cell corner
layout(location = 5) flat out vec4 outDomain;
layout(location = 6) flat out vec2 outCell;
layout(location = 7) flat out uvec2 outFlagsId;

invariant gl_Position;

void main() {
  InstanceData instance = instances[gl_InstanceIndex];
  outPosition = relativeFromObject(instance, inPosition);
  outNormal = unitOrZero(instance.normalFromObject * inNormal);

  vec2 lower = instance.domain.xy, width = instance.domain.zw;
  vec2 upper = inParameters;
  if ((instance.flags & kSeamU) != 0 && inParameters.x == lower.x) upper.x += width.x;
  if ((instance.flags & kSeamV) != 0 && inParameters.y == lower.y) upper.y += width.y;
  bool collapsed = ((instance.flags & kCollapsedVMin) != 0 && inParameters.y == lower.y) ||
                   ((instance.flags & kCollapsedVMax) != 0 && inParameters.y == lower.y + width.y);
  outWeight = collapsed ? 0.0 : 1.0;
  outParameters = vec4(inParameters.x * outWeight, inParameters.y, upper.x * outWeight, upper.y);
  outCorner = inParameters;
  outDomain = instance.domain;
  outCell = instance.cell;
  outFlagsId = uvec2(instance.flags, instance.id);
  gl_Position = view.clipFromRelative * vec4(outPosition, 1);
}
