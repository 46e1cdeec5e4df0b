// SPDX-License-Identifier: Apache-2.0
// Vertices of a mesh, for the views of geometry.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/inspect_vertex.glsl"
