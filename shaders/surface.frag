// SPDX-License-Identifier: Apache-2.0
// Light per fragment: scene-linear colour and opacity.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/surface_fragment.glsl"

void main() { outColor = shadedFragment(inAmbient, inDiffuse); }
