// SPDX-License-Identifier: Apache-2.0
// The edges of the triangles in the material's own colour, bright enough to be seen on any background. They have no
// residual, which alpha would tell.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/bindings.h"

layout(location = kLocationLineDiffuse) flat in vec3 inDiffuse;

layout(location = 0) out vec4 outColor;

void main() { outColor = vec4(0.25 + 0.75 * inDiffuse, 0); }
