// SPDX-License-Identifier: Apache-2.0
// Vertices of a surface with a pattern, for shading per fragment.
#include "lib/rest_frame.glsl"
#include "lib/surface_vertex.glsl"

layout(location = kAttributeParameters) in vec2 inParameters;

layout(location = kLocationDetail) sample out vec3 outDetail;  // u, v, silhouette()
layout(location = kLocationParameterBounds) flat out vec4 outParameterBounds;
#ifdef LUXO_RAY_FOOTPRINT
layout(location = kAttributePointFootprint) in vec4 inFootprint;
layout(location = kLocationFootprint) flat out vec4 outFootprint;
#endif
#ifdef LUXO_RAY_FRAME
layout(location = kAttributePointFrame) in vec4 inFrame;
layout(location = kLocationFrame) flat out vec4 outFrame;
#endif
#ifdef LUXO_TANGENTS
layout(location = kAttributeTangent) in vec4 inTangent;
layout(location = kLocationTangent) sample out vec4 outTangent;
layout(location = kLocationRestNormal) sample out vec3 outRestNormal;  // of what has moved: then the tangent is a point, and 4
#endif

void main() {
  InstanceData instance = instanceOfVertex();
  writeSurfaceVertex(instance);
  outDetail = vec3(inParameters, silhouette(instance));
  outParameterBounds = parameterBounds(instance);
#ifdef LUXO_RAY_FOOTPRINT
  outFootprint = inFootprint;
#endif
#ifdef LUXO_RAY_FRAME
  outFrame = inFrame;
#endif
#ifdef LUXO_TANGENTS
  float handed = determinant(linearOf(instance)) < 0.0 ? -inTangent.w : inTangent.w;
  outTangent = vec4(unitOrZero(linearOf(instance) * inTangent.xyz), handed);
  outRestNormal = vec3(0);
  if (isRest(inTangent)) {
    outTangent = vec4(inTangent.xyz, 4.0);
    outRestNormal = restNormal(inTangent);
  }
#endif
}
