// SPDX-License-Identifier: Apache-2.0
// Vertices of a surface, for shading per fragment with a pattern or an outline.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/surface_vertex.glsl"

layout(location = 2) in vec2 inParameters;

layout(location = 14) sample out vec3 outDetail;  // u, v; (N.V) |N.V|
layout(location = 15) flat out uint outFirstParameter;

void main() {
  InstanceData instance = instances[gl_InstanceIndex];
  writeSurfaceVertex(instance);
  // Near a silhouette this is proportional to the distance from it in the picture, so that its interpolation between
  // vertices is exact there. A plane has no silhouette.
  float facing = dot(outNormal, towardViewer(view.viewer, outPosition));
  outDetail = vec3(inParameters, (instance.flags & kPlane) != 0 ? 1.0 : facing * abs(facing));
  outFirstParameter = instance.firstPatternParameter;
}
