// SPDX-License-Identifier: Apache-2.0
// A caster's mesh, flattened onto a plane along the rays of a light.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/scene_data.h"

layout(location = kAttributePosition) in vec3 inPosition;
layout(scalar, push_constant) uniform Draw { FlatShadow draw; };

layout(location = kLocationFlatHeight) out float outHeight;

void main() {
  outHeight = dot(draw.height, vec4(inPosition, 1));
  gl_Position = draw.clipFromObject * vec4(inPosition, 1);
}
