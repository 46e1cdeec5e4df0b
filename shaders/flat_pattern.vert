// SPDX-License-Identifier: Apache-2.0
// As flat_shadow.vert, of a caster that has a pattern or a map.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/scene_data.h"

layout(location = kAttributePosition) in vec3 inPosition;
layout(location = kAttributeParameters) in vec2 inParameters;
layout(scalar, push_constant) uniform Draw { FlatShadow draw; };

layout(location = kLocationFlatHeight) out float outHeight;
layout(location = kLocationFlatParameters) out vec2 outParameters;

void main() {
  outHeight = dot(draw.height, vec4(inPosition, 1));
  outParameters = inParameters;
  gl_Position = draw.clipFromObject * vec4(inPosition, 1);
}
