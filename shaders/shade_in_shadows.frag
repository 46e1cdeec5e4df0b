// SPDX-License-Identifier: Apache-2.0
// The light on what an earlier pass has found, where another has found what is in shadow.
#version 460
#extension GL_GOOGLE_include_directive : require
#define LUXO_SHADOWS
#include "lib/shade_fragment.glsl"
#include "lib/lit_plain.glsl"

void main() { shade(); }
