// SPDX-License-Identifier: Apache-2.0
// Points of triangles that are lit later, with their parameters and their footprint.
#version 460
#extension GL_GOOGLE_include_directive : require
#define LUXO_FINDS_PARAMETERS
#define LUXO_FINDS_FOOTPRINT
#include "lib/textured_surface.glsl"
#include "lib/lit_plain.glsl"

layout(location = kLocationParameterBounds) flat in vec4 inParameterBounds;

vec4 patternBounds() { return inParameterBounds; }

void main() { show(foundPoint(), 1.0); }
