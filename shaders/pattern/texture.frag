// SPDX-License-Identifier: Apache-2.0
// Light per fragment on a texture.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/textured_surface.glsl"
#include "lib/pattern_of_mesh.glsl"
#include "lib/lit_pattern.glsl"

#ifdef LUXO_SHADER
layout(early_fragment_tests) in;  // what is hidden has no faults to tell
#endif

void main() { show(foundPoint(), foundOpacity()); }
