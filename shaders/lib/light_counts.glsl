// SPDX-License-Identifier: Apache-2.0
// How many lights reach a draw: known when the pipeline is made, so that loops over them unroll and an unneeded light
// costs nothing. The shaded ones are the last. And which of them are spots.
#ifndef LUXO_LIB_LIGHT_COUNTS_GLSL
#define LUXO_LIB_LIGHT_COUNTS_GLSL
#include "shared/scene_data.h"

layout(constant_id = kConstantPlainLights) const uint kPlainLights = 0;
layout(constant_id = kConstantShadedLights) const uint kShadedLights = 0;
layout(constant_id = kConstantSpots) const uint kSpots = 0;  // a bit each
#endif
