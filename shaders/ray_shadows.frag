// SPDX-License-Identifier: Apache-2.0
// What rays have found of the shadows in a pixel.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/bindings.h"

layout(location = kLocationShadows) flat in uint inShadows;
layout(location = 0) out uint outShadows;

void main() { outShadows = inShadows; }
