// SPDX-License-Identifier: Apache-2.0
// Light per vertex.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/gouraud_vertex.glsl"
