// SPDX-License-Identifier: Apache-2.0
// The frame of maps of normals (engine/scene/normal_map.h) at a point of triangles: with LUXO_BY_RAYS from the ray that has
// found it; with LUXO_VERTEX_TANGENTS between those of the vertices, or where a point was that has moved; of formulas from
// how (u, v) lie on the triangle.
#include "lib/rest_frame.glsl"
#if defined(LUXO_BY_RAYS)
layout(location = kLocationFrame) flat in vec4 inFrame;
vec4 normalFrame() { return inFrame; }

#else

// Whether the inner side is shown, so that normals are turned over.
bool isTurned(vec3 v) {
  bool turns = (inNumbers.x & kTwoSided) != 0;
  return turns && (kFacetNormal ? !gl_FrontFacing : !seenFromFront(unitOrZero(inNormal), v, gl_FrontFacing));
}

#ifdef LUXO_VERTEX_TANGENTS
layout(location = kLocationTangent) sample in vec4 inTangent;
layout(location = kLocationRestNormal) sample in vec3 inRestNormal;

vec4 normalFrame() {
  vec3 facet = kFacetNormal ? cross(dFdx(inTangent.xyz), dFdy(inTangent.xyz)) : vec3(0);
  if (isRest(inTangent)) {
    vec3 n = dot(facet, facet) > 0.0 ? (dot(facet, inRestNormal) < 0.0 ? -facet : facet) : inRestNormal;
    return restFrame(inTangent.xyz, isTurned(towardViewer(viewerOfDraw(), inPosition)) ? -n : n);
  }
  vec4 frame = vec4(inTangent.xyz, inTangent.w * length(inNormal));
  return isTurned(towardViewer(viewerOfDraw(), inPosition)) ? -frame : frame;
}

#else

vec4 normalFrame() {
  vec3 v = towardViewer(viewerOfDraw(), inPosition), n = fragmentNormal(v);
  vec3 right = dFdxFine(inPosition), below = dFdyFine(inPosition);
  vec2 uvRight = dFdxFine(inDetail.xy), uvBelow = dFdyFine(inDetail.xy);
  float area = uvRight.x * uvBelow.y - uvBelow.x * uvRight.y, side = area < 0.0 ? -1.0 : 1.0;
  vec3 alongU = side * (right * uvBelow.y - below * uvRight.y);
  vec3 tangent = unitOrZero(alongU - n * dot(n, alongU));
  return vec4(isTurned(v) ? -tangent : tangent, side * dot(cross(right, below), n) < 0.0 ? -1.0 : 1.0);
}
#endif
#endif
