// SPDX-License-Identifier: Apache-2.0
// Triangles that are drawn again, to light the points that they have put down before: now it is known which lights reach
// these. Where the points are lib/again_found.glsl and lib/again_layer.glsl know; what light they reflect lib/toon.glsl and
// lib/gouraud_again.glsl.
#ifndef LUXO_LIB_AGAIN_GLSL
#define LUXO_LIB_AGAIN_GLSL
#include "shared/scene_data.h"

layout(constant_id = kConstantTransmits) const bool kTransmits = false;
layout(constant_id = kConstantAddsLight) const bool kAddsLight = false;

struct DrawnPoint {
  vec3 position, normal;
  uint shadows;        // the lights, a bit each, that do not reach it
  vec3 transmittance;  // how much of the only light gets through to it
};

DrawnPoint point;

// Whether the fragment's own point is there, which is `point` then.
bool findPoint(uint material);

// What it reflects; its diffuse colour, and its opacity.
void lightPoint(vec3 light, vec4 paint);

uint shadowsOfPoint() { return point.shadows; }
vec3 throughToPoint() { return kTransmits ? point.transmittance : vec3(1); }
#endif
