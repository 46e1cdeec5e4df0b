// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "knot_data.glsl"
#include "shared/bindings.h"

layout(location = kAttributePosition) in vec3 inPosition;
layout(location = kAttributeNormal) in vec3 inNormal;
layout(location = 0) out vec3 outPosition;
layout(location = 1) out vec3 outNormal;

void main() {
  outPosition = inPosition;
  outNormal = inNormal;
  gl_Position = clipFromWorld * vec4(inPosition, 1);
}
