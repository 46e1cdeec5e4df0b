// SPDX-License-Identifier: Apache-2.0
// Vertices for the views of geometry: position, normal, surface parameters, number of the node.
#include "lib/placed_vertex.glsl"

layout(location = kAttributeParameters) in vec2 inParameters;

layout(location = 0) sample out vec3 outPosition;
layout(location = 1) sample out vec3 outNormal;
layout(location = 2) sample out vec2 outParameters;
layout(location = 3) flat out vec4 outDomain;
layout(location = 4) flat out uvec2 outFlagsId;
layout(location = 5) sample out float outDepth;

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
