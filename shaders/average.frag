// SPDX-License-Identifier: Apache-2.0
// A picture joins a mean: blending takes this part of it and the rest of what is there.
#version 460

layout(push_constant) uniform Weight { float weight; };
layout(set = 0, binding = 0) uniform sampler2D picture;

layout(location = 0) out vec4 outColor;

void main() { outColor = vec4(texelFetch(picture, ivec2(gl_FragCoord.xy), 0).rgb, weight); }
