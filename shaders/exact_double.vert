// SPDX-License-Identifier: Apache-2.0
// Vertices of hulls whose surfaces are searched for in double.
#version 460
#extension GL_GOOGLE_include_directive : require
#define LUXO_DOUBLE
#include "lib/hull_vertex.glsl"
