// SPDX-License-Identifier: Apache-2.0
// The light on what an earlier pass has found, on a pattern, where another has found what is in shadow.
#version 460
#extension GL_GOOGLE_include_directive : require
#define LUXO_SHADOWS
#include "lib/shade_fragment.glsl"
#include "lib/lit_pattern.glsl"

#ifdef LUXO_SHADER
layout(early_fragment_tests) in;  // where nothing is found no shader runs, to have faults or send rays
#endif

uint firstPatternParameter() { return material.firstPatternParameter; }
vec4 patternBounds() { return vec4(vec2(-3e38), vec2(3e38)); }  // what was found is within them

void main() { shade(); }
