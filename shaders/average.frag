// SPDX-License-Identifier: Apache-2.0
// A picture joins a mean (gpu::Blend::Mean). Its alpha tells how good a point is, negative where nothing is certain; the
// largest stays, and what is uncertain is always larger.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/picture_set.h"

layout(constant_id = kConstantUncertain) const float kUncertain = 0;

layout(set = kSetPicture, binding = kBindingPicture) uniform sampler2D picture;

layout(location = 0) out vec4 outColor;

void main() {
  vec4 color = texelFetch(picture, ivec2(gl_FragCoord.xy), 0);
  outColor = vec4(color.rgb, color.a < 0.0 ? kUncertain - color.a : color.a);
}
