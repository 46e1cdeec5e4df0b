// SPDX-License-Identifier: Apache-2.0
// Geometry of triangles instead of light. Alpha is 1 where a surface is; of colours it is a residual, as that of light is,
// and triangles have none.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/inspection.glsl"
#include "lib/pixel_ray.glsl"

layout(constant_id = kConstantQuantity) const uint kQuantity = kPosition;
layout(constant_id = kConstantAsColor) const bool kAsColor = false;
layout(constant_id = kConstantCertificate) const uint kCertificateOfAll = kUncertified;  // but of undecided points

layout(location = kLocationPosition) sample in vec3 inPosition;
layout(location = kLocationNormal) sample in vec3 inNormal;
layout(location = kLocationInspectedParameters) sample in vec2 inParameters;
layout(location = kLocationInspectedDomain) flat in vec4 inDomain;
layout(location = kLocationInspectedFlagsId) flat in uvec2 inFlagsId;
layout(location = kLocationInspectedDepth) sample in float inDepth;

layout(location = 0) out vec4 outValue;

void main() {
  vec3 position = seenByPixel(inPosition), n = unitOrZero(inNormal);
  if ((inFlagsId.x & kTwoSided) != 0 && !seenFromFront(n, towardViewer(view.viewer, position), gl_FrontFacing)) n = -n;
  float depth = inDepth + dot(position - inPosition, view.forward.xyz);
  // Triangles are drawn where their fragments are: they have no residual.
  uint certificate = (inFlagsId.x & kUndecided) != 0 ? kUncertified : kCertificateOfAll;
  Inspected inspected = Inspected(position, n, inParameters, depth, inFlagsId.y, 0.0, certificate);
  vec4 domain = vec4(inDomain.xy, inDomain.xy + inDomain.zw);
  outValue = vec4(inspectedValue(inspected, kQuantity, kAsColor, domain), kAsColor ? 0 : 1);
}
