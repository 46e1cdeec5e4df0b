// SPDX-License-Identifier: Apache-2.0
// Vertices of a surface that is drawn with an outline.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/surface_vertex.glsl"

layout(location = kLocationDetail) sample out vec3 outDetail;  // no parameters; silhouette()

void main() {
  InstanceData instance = instanceOfVertex();
  writeSurfaceVertex(instance);
  outDetail = vec3(0, 0, silhouette(instance));
}
