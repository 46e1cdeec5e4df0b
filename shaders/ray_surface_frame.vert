// SPDX-License-Identifier: Apache-2.0
// Points of a surface with a map of normals that rays have found, for shading per fragment.
#version 460
#extension GL_GOOGLE_include_directive : require
#define LUXO_RAY_POINT
#define LUXO_RAY_FOOTPRINT
#define LUXO_RAY_FRAME
#include "lib/surface_pattern_vertex.glsl"
