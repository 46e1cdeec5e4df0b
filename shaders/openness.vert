// SPDX-License-Identifier: Apache-2.0
// The whole target, for how open the sky is above what was found.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/viewed_target.glsl"

void main() { viewTarget(); }
