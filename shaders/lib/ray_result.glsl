// SPDX-License-Identifier: Apache-2.0
// What is known of whether a ray meets something: it does, it does not, or floats do not tell.
#ifndef LUXO_LIB_RAY_RESULT_GLSL
#define LUXO_LIB_RAY_RESULT_GLSL

const int kMet = 1, kPassed = 0, kOpen = 2;
#endif
