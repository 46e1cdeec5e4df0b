// SPDX-License-Identifier: Apache-2.0
// The pattern of a material on triangles, whose vertices say what of it is theirs.
#include "lib/pattern.glsl"

layout(location = 6, component = 1) flat in uint inFirstParameter;
layout(location = 15) flat in vec4 inParameterBounds;

uint firstPatternParameter() { return inFirstParameter; }
vec4 patternBounds() { return inParameterBounds; }
