// SPDX-License-Identifier: Apache-2.0
// How many of a formula's parameters are held at most: a CPU device reads a buffer slowly, so they are read once, not
// whenever the formula is.
#ifndef LUXO_LIB_HELD_PARAMETERS_GLSL
#define LUXO_LIB_HELD_PARAMETERS_GLSL

const uint kHeldParameters = 64;
#endif
