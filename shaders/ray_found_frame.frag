// SPDX-License-Identifier: Apache-2.0
// Points that rays have found and that are lit later, with all that maps ask for.
#version 460
#extension GL_GOOGLE_include_directive : require
#define LUXO_BY_RAYS
#define LUXO_FINDS_PARAMETERS
#define LUXO_FINDS_FOOTPRINT
#define LUXO_FINDS_FRAME
#include "lib/textured_surface.glsl"
#include "lib/lit_plain.glsl"

layout(location = kLocationParameterBounds) flat in vec4 inParameterBounds;

vec4 patternBounds() { return inParameterBounds; }

void main() { show(foundPoint(), 1.0); }
