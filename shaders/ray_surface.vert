// SPDX-License-Identifier: Apache-2.0
// Points of a surface that rays have found, for shading per fragment.
#version 460
#extension GL_GOOGLE_include_directive : require
#define LUXO_RAY_POINT
#include "lib/surface_vertex.glsl"

void main() { writeSurfaceVertex(instanceOfVertex()); }
