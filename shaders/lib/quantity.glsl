// SPDX-License-Identifier: Apache-2.0
// What the fragments of a draw tell of the points that they find.
#ifndef LUXO_LIB_QUANTITY_GLSL
#define LUXO_LIB_QUANTITY_GLSL
#include "shared/scene_data.h"

layout(constant_id = kConstantQuantity) const uint kQuantity = kLight;
layout(constant_id = kConstantAsColor) const bool kAsColor = false;
#endif
