// SPDX-License-Identifier: Apache-2.0
// What is a number: NaN and infinity are none. By its bits, as compilers may take comparisons of NaN for what they like.
#ifndef LUXO_LIB_NUMBER_GLSL
#define LUXO_LIB_NUMBER_GLSL

bool isNumber(float x) { return (floatBitsToUint(x) & 0x7fffffffu) < 0x7f800000u; }
bool isColor(vec3 light) { return isNumber(light.r) && isNumber(light.g) && isNumber(light.b); }

#endif
