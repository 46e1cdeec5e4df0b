// SPDX-License-Identifier: Apache-2.0
// Light per fragment on a pattern.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/surface_fragment.glsl"
#include "lib/pattern_of_mesh.glsl"
#include "lib/lit_pattern.glsl"

layout(location = kLocationDetail) sample in vec3 inDetail;

vec2 foundParameters() { return inDetail.xy; }

void main() { show(foundPoint(), foundOpacity()); }
