// SPDX-License-Identifier: Apache-2.0
// Light per fragment on a pattern.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/surface_fragment.glsl"
#include "lib/pattern_of_mesh.glsl"

layout(location = 14) sample in vec3 inDetail;

void main() {
  vec3 color = patternAt(inDetail.xy);
  outColor = shadedFragment((inFlags & kPatternAmbient) != 0 ? color * inAmbient : inAmbient, color);
}
