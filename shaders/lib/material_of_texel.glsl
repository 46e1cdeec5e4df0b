// SPDX-License-Identifier: Apache-2.0
// The number of a found point's material (lib/found_texel.glsl).
#ifndef LUXO_LIB_MATERIAL_OF_TEXEL_GLSL
#define LUXO_LIB_MATERIAL_OF_TEXEL_GLSL

uint materialOfTexel(vec4 texel) { return floatBitsToUint(texel.w) & 0xffffu; }
#endif
