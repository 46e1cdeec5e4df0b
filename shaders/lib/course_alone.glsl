// SPDX-License-Identifier: Apache-2.0
// A program in the style of GLSL 1.20 by itself, of a vertex with LUXO_VERTEX, of a fragment without: to find its errors,
// and which uniforms, attributes and varyings it has. It is never drawn. The file "material" is its own.
#version 460
#extension GL_GOOGLE_include_directive : require
#define LUXO_ALONE
#include "lib/course.glsl"

bool luxoStops() { return luxoTexels[0].x > 0.0; }
#define LUXO_ASKS if (luxoStops()) break; else

#include "material"

void main() { mAin(); }
