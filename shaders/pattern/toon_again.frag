// SPDX-License-Identifier: Apache-2.0
// A drawing in two levels with an outline where there are shadows, of a pattern.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/again.glsl"
#include "lib/toon.glsl"
#include "lib/pattern_of_mesh.glsl"
#ifdef LUXO_TEXTURED
#include "lib/mesh_footprint.glsl"
vec4 pixelFootprint() { return footprintOnTriangle(inPosition, inDetail.xy); }
#include "lib/maps.glsl"
#ifdef LUXO_FRAMED
#include "lib/mesh_frame.glsl"
#endif
#endif
#include "lib/again_found.glsl"

void main() {
  vec4 paint = paintAt(inDetail.xy);
  drawAgain(vec4(paint.rgb, foundOpacity() * paint.a));
}
