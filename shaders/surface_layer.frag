// SPDX-License-Identifier: Apache-2.0
// Points of triangles that are seen through, to be lit later.
#version 460
#extension GL_GOOGLE_include_directive : require
#define LUXO_FINDS_LAYER
#include "lib/layers.glsl"
#include "lib/octahedral.glsl"
#include "lib/surface_fragment.glsl"
#include "lib/lit_plain.glsl"

layout(location = kLocationDetail) sample in vec3 inDetail;
layout(location = kLocationParameterBounds) flat in vec4 inParameterBounds;

vec2 foundParameters() { return clamp(inDetail.xy, inParameterBounds.xy, inParameterBounds.zw); }
vec4 patternBounds() { return inParameterBounds; }

void main() {
  Found found = foundPoint();
  setTriangle(addLayer(unlitPoint(dot(found.position, view.forward.xyz), 0.0, inNumbers.y | layerOfTriangles(inNumbers.x),
                                  octahedral(found.normal), found.parameters)));
}
