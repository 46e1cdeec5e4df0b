// SPDX-License-Identifier: Apache-2.0
// Geometry instead of light: as numbers (auxiliary outputs) or as colours (debug views). Alpha is 1 where a surface is.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/scene.glsl"

// What is written: 0 position relative to the eye, 1 normal, 2 parameters, 3 depth, 4 number of the node.
layout(constant_id = 0) const uint kQuantity = 0;
layout(constant_id = 1) const bool kAsColor = false;

layout(location = 0) sample in vec3 inPosition;
layout(location = 1) sample in vec3 inNormal;
layout(location = 2) sample in vec2 inParameters;
layout(location = 3) flat in vec4 inDomain;
layout(location = 4) flat in uvec2 inFlagsId;

layout(location = 0) out vec4 outValue;

// Colours of neighbouring numbers lie a golden angle apart on the hue circle: any few nodes are told apart.
vec3 colorOfId(uint id) {
  vec3 hue = fract(float(id) * 0.61803399 + vec3(0.0, 1.0 / 3.0, 2.0 / 3.0));
  return 0.15 + 0.75 * smoothstep(0.0, 1.0, abs(2.0 * hue - 1.0));
}

void main() {
  vec3 value;
  if (kQuantity == 0) {
    value = inPosition;
  } else if (kQuantity == 1) {
    vec3 n = unitOrZero(inNormal);
    if ((inFlagsId.x & kTwoSided) != 0 && !seenFromFront(n, towardViewer(view.viewer, inPosition), gl_FrontFacing)) n = -n;
    value = kAsColor ? 0.5 + 0.5 * n : n;
  } else if (kQuantity == 2) {
    value = vec3(kAsColor ? (inParameters - inDomain.xy) / inDomain.zw : inParameters, 0);
  } else if (kQuantity == 3) {
    float depth = dot(inPosition, view.forward);
    float nearness = (view.depthRange.y - depth) / max(view.depthRange.y - view.depthRange.x, 1e-30);
    value = vec3(kAsColor ? 0.02 + 0.98 * clamp(nearness, 0.0, 1.0) : depth);
  } else if (kQuantity == 4) {
    value = kAsColor ? colorOfId(inFlagsId.y) : vec3(inFlagsId.y);
  } else {
    value = vec3(0);  // triangles are drawn where their fragments are
  }
  outValue = vec4(value, 1);
}
