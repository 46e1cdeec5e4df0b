// SPDX-License-Identifier: Apache-2.0
// A drawing in two levels with an outline.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/toon.glsl"

void main() { outColor = vec4(drawn(foundMaterial().diffuse), foundOpacity()); }
