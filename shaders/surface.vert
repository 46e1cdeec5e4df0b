// SPDX-License-Identifier: Apache-2.0
// Vertices of a surface, for shading per fragment.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/surface_vertex.glsl"

void main() { writeSurfaceVertex(instanceOfVertex()); }
