// SPDX-License-Identifier: Apache-2.0
// A surface with a pattern found in every pixel, in double.
#version 460
#extension GL_GOOGLE_include_directive : require
#define LUXO_DOUBLE
#include "lib/exact_pattern.glsl"
