// SPDX-License-Identifier: Apache-2.0
// A surface with a pattern found in every pixel. The files "surface" and "pattern" are made from formulas.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/exact_fragment.glsl"
#include "lib/lit_pattern.glsl"

uint firstPatternParameter() { return varyingFlags.z; }

void main() { showPoint(); }
