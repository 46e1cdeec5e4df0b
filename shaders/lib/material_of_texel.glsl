// SPDX-License-Identifier: Apache-2.0
// The last float of a found point (lib/found_texel.glsl): the number of its material, and its residual, which is never 0
// where something was found.
#ifndef LUXO_LIB_MATERIAL_OF_TEXEL_GLSL
#define LUXO_LIB_MATERIAL_OF_TEXEL_GLSL
#include "shared/scene_data.h"

const uint kMaterialBits = uint(kMaxFoundMaterials) - 1u;

uint materialOfTexel(vec4 texel) { return floatBitsToUint(texel.w) & kMaterialBits; }
float residualOfTexel(vec4 texel) { return uintBitsToFloat(floatBitsToUint(texel.w) & ~kMaterialBits); }
#endif
