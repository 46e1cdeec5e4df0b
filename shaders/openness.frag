// SPDX-License-Identifier: Apache-2.0
// How open the sky is above what an earlier pass has found.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/found.glsl"
#include "lib/octahedral.glsl"
#include "lib/scene.glsl"

layout(set = kSetFound, binding = kBindingFound) uniform sampler2D foundTexels;

layout(location = kLocationTargetViewer) flat in vec4 inViewer;
layout(location = kLocationTargetPlace) flat in vec3 inPlace[3];
layout(location = kLocationTargetRay) flat in vec3 inRay[3];
layout(location = kLocationTargetMiddle) flat in vec2 inMiddle;

layout(location = 0) out float outOpenness;

#include "lib/openness.glsl"

void main() {
  ivec2 here = ivec2(gl_FragCoord.xy);
  vec4 texel = texelFetch(foundTexels, here, 0);
  vec3 position = positionAt(here, texel.x);
  outOpenness = opennessOf(here, texel.x, position, fromOctahedral(texel.yz), towardViewer(inViewer, position));
}
