// SPDX-License-Identifier: Apache-2.0
// Points that rays have found, for the views of geometry.
#version 460
#extension GL_GOOGLE_include_directive : require
#define LUXO_RAY_POINT
#include "lib/inspect_vertex.glsl"
