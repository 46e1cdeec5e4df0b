// SPDX-License-Identifier: Apache-2.0
// Shadows, by equations, on what is seen.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/closed_fragment.glsl"

void main() { findShadows(); }
