// SPDX-License-Identifier: Apache-2.0
// Scene-linear picture -> window: clamped and encoded as sRGB here, because drivers disagree on their own encode.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/picture_set.h"

layout(set = kSetPicture, binding = kBindingPicture) uniform sampler2D picture;

layout(location = 0) out vec4 outColor;

vec3 encodeSrgb(vec3 linear) {
  vec3 c = clamp(linear, 0.0, 1.0);
  vec3 curve = 1.055 * exp2(log2(max(c, 1e-6)) / 2.4) - 0.055;
  return mix(curve, 12.92 * c, lessThanEqual(c, vec3(0.0031308)));
}

// What is no number is magenta, as in files; blending may have made the largest float of an infinity.
const float kLargest = 3.40282347e38;
vec3 shown(vec3 c) { return any(isnan(c)) || any(greaterThanEqual(abs(c), vec3(kLargest))) ? vec3(1, 0, 1) : c; }

void main() { outColor = vec4(encodeSrgb(shown(texelFetch(picture, ivec2(gl_FragCoord.xy), 0).rgb)), 1); }
