// SPDX-License-Identifier: Apache-2.0
// Where a point of triangles that a vertex program has moved was before, in the place of the frame of maps of normals:
// engine/draw/rest_frame.h has the same.
#ifndef LUXO_LIB_REST_FRAME_GLSL
#define LUXO_LIB_REST_FRAME_GLSL
#extension GL_GOOGLE_include_directive : require
#include "lib/octahedral.glsl"
#include "shared/scene_data.h"

bool isRest(vec4 frame) { return abs(frame.w) >= 2.0; }

vec4 restFrame(vec3 point, vec3 normal) {
  uvec2 steps = uvec2(round(kRestSteps * (octahedral(normal) + 1.0)));
  uint packed_ = steps.x << 15 | steps.y;
  return vec4(point, uintBitsToFloat(0x40000000u | (packed_ & 0x1fffffffu) | packed_ >> 29 << 31));
}

vec3 restNormal(vec4 frame) {
  uint bits = floatBitsToUint(frame.w), packed_ = (bits & 0x1fffffffu) | bits >> 31 << 29;
  return fromOctahedral(vec2(packed_ >> 15, packed_ & 0x7fffu) / kRestSteps - 1.0);
}

#endif
