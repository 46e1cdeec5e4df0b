// SPDX-License-Identifier: Apache-2.0
// Points of triangles that have tangents that are seen through, with all that maps ask for.
#version 460
#extension GL_GOOGLE_include_directive : require
#define LUXO_VERTEX_TANGENTS
#include "lib/framed_layer.glsl"

void main() { addFramedLayer(); }
