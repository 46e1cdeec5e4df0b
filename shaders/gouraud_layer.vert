// SPDX-License-Identifier: Apache-2.0
// Light per vertex, of what is seen through.
#version 460
#extension GL_GOOGLE_include_directive : require
#define LUXO_LAYER
#include "lib/gouraud_vertex.glsl"
