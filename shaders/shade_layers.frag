// SPDX-License-Identifier: Apache-2.0
// The light on what is seen through.
#version 460
#extension GL_GOOGLE_include_directive : require
#define LUXO_SHADOWS
#include "lib/shade_layers.glsl"
#include "lib/lit_plain.glsl"

vec4 paintOf(Found found) { return vec4(material.diffuse, material.opacity); }

void main() { shadeLayers(); }
