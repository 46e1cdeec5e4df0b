// SPDX-License-Identifier: Apache-2.0
// How much of a light rays have found to get through its casters in a pixel.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/bindings.h"

layout(location = kLocationTransmittance) flat in vec3 inTransmittance;
layout(location = 0) out vec4 outTransmittance;

void main() { outTransmittance = vec4(inTransmittance, 1); }
