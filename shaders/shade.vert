// SPDX-License-Identifier: Apache-2.0
// The whole target, for the light on what was found, with the lights that its fragments read often.
#version 460
#extension GL_GOOGLE_include_directive : require
#define LUXO_VERTEX
#include "lib/carried_lights.glsl"
#include "lib/viewed_target.glsl"

void main() {
  viewTarget();
  carryLights();
}
