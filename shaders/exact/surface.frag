// SPDX-License-Identifier: Apache-2.0
// A surface found in every pixel. The file "surface" is made from its formula.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/exact_fragment.glsl"
#include "lib/lit_plain.glsl"

void main() { showPoint(); }
