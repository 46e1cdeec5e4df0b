// SPDX-License-Identifier: Apache-2.0
// A drawing in two levels with an outline where there are shadows.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/again.glsl"
#include "lib/toon.glsl"
#include "lib/again_found.glsl"

void main() { drawAgain(vec4(foundMaterial().diffuse, foundOpacity())); }
