// SPDX-License-Identifier: Apache-2.0
// Points of triangles of a formula that are seen through, with all that maps ask for.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/framed_layer.glsl"

void main() { addFramedLayer(); }
