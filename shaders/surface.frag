// SPDX-License-Identifier: Apache-2.0
// Light per fragment: scene-linear colour and opacity.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/surface_fragment.glsl"
#include "lib/lit_plain.glsl"

vec2 foundParameters() { return vec2(0); }

void main() { show(foundPoint(), foundOpacity()); }
