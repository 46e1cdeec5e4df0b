// SPDX-License-Identifier: Apache-2.0
// A surface found in every pixel, in double. The file "surface" is made from its formula.
#version 460
#extension GL_GOOGLE_include_directive : require
#define LUXO_DOUBLE
#include "lib/exact_fragment.glsl"

void main() { show(seenPoint(), linkAmbientShininess.rgb, linkDiffuseOpacity.rgb); }
