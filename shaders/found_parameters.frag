// SPDX-License-Identifier: Apache-2.0
// Points of triangles that are lit later, with their parameters.
#version 460
#extension GL_GOOGLE_include_directive : require
#define LUXO_FINDS_PARAMETERS
#include "lib/surface_fragment.glsl"
#include "lib/lit_plain.glsl"

layout(location = kLocationDetail) sample in vec3 inDetail;
layout(location = kLocationParameterBounds) flat in vec4 inParameterBounds;

vec2 foundParameters() { return inDetail.xy; }
vec4 patternBounds() { return inParameterBounds; }

void main() { show(foundPoint(), 1.0); }
