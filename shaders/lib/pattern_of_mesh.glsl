// SPDX-License-Identifier: Apache-2.0
// The pattern of a material on triangles, whose vertices say what of it is theirs: inNumbers, of whoever includes this.
#include "lib/pattern.glsl"

layout(location = kLocationParameterBounds) flat in vec4 inParameterBounds;

uint firstPatternParameter() { return inNumbers.z; }
vec4 patternBounds() { return inParameterBounds; }
