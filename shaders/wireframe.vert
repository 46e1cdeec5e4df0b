// SPDX-License-Identifier: Apache-2.0
// Vertices of a surface whose edges are drawn in one colour.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/instance_vertex.glsl"

layout(location = kAttributePosition) in vec3 inPosition;

layout(location = kLocationLineDiffuse) flat out vec3 outDiffuse;

invariant gl_Position;

void main() {
  InstanceData instance = instanceOfVertex();
  outDiffuse = materials[instance.material].diffuse;
  gl_Position = view.clipFromRelative * vec4(relativeFromObject(instance, inPosition), 1);
}
