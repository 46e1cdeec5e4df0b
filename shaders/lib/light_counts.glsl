// SPDX-License-Identifier: Apache-2.0
// How many lights reach a draw: known when the pipeline is made, so that loops over them unroll and an unneeded light
// costs nothing. The shaded ones are the last.
#ifndef LUXO_LIB_LIGHT_COUNTS_GLSL
#define LUXO_LIB_LIGHT_COUNTS_GLSL

layout(constant_id = 0) const uint kPlainLights = 0;
layout(constant_id = 1) const uint kShadedLights = 0;
#endif
