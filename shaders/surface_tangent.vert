// SPDX-License-Identifier: Apache-2.0
// Vertices of a mesh with tangents, for maps of normals.
#version 460
#extension GL_GOOGLE_include_directive : require
#define LUXO_TANGENTS
#include "lib/surface_pattern_vertex.glsl"
