// SPDX-License-Identifier: Apache-2.0
// A caster's mesh as its light sees it: nothing but depth.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/scene_data.h"

layout(location = kAttributePosition) in vec3 inPosition;
layout(scalar, push_constant) uniform Draw { mat4 clipFromObject; };

void main() { gl_Position = clipFromObject * vec4(inPosition, 1); }
