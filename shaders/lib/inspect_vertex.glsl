// SPDX-License-Identifier: Apache-2.0
// Vertices for the views of geometry: position, normal, surface parameters, number of the node.
#include "lib/placed_vertex.glsl"

layout(location = kAttributeParameters) in vec2 inParameters;

layout(location = kLocationPosition) sample out vec3 outPosition;
layout(location = kLocationNormal) sample out vec3 outNormal;
layout(location = kLocationInspectedParameters) sample out vec2 outParameters;
layout(location = kLocationInspectedDomain) flat out vec4 outDomain;
layout(location = kLocationInspectedFlagsId) flat out uvec2 outFlagsId;
layout(location = kLocationInspectedDepth) sample out float outDepth;

invariant gl_Position;

void main() {
  InstanceData instance = instanceOfVertex();
  outPosition = positionOfVertex(instance);
  outNormal = normalOfVertex(instance);
  outParameters = inParameters;
  outDepth = depthOfVertex(outPosition);
  outDomain = instance.domain;
  outFlagsId = uvec2(flagsOfVertex(instance), instance.id);
  gl_Position = clipOfVertex(outPosition);
}
