// SPDX-License-Identifier: Apache-2.0
// Vertices of shells whose surfaces are searched for in single precision.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/shell_vertex.glsl"
