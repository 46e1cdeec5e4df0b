// SPDX-License-Identifier: Apache-2.0
// Vertices of a mesh with a pattern, for shading per fragment.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/surface_pattern_vertex.glsl"
