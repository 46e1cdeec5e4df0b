// SPDX-License-Identifier: Apache-2.0
// What this device makes of sin and cos (draw/device_precision.h): its own, and those of formulas. One angle per pixel,
// from -pi to pi; as a single product it is the same number on the host.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/formula.glsl"
#include "shared/sin_cos_angles.h"

layout(location = 0) out vec4 outValues;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float angle = float(pixel.y * int(kAngleColumns) + pixel.x - int(kAngleColumns * kAngleRows / 2)) * kAngleStep;
  outValues = vec4(sin(angle), cos(angle), formulaSinCos(angle));
}
