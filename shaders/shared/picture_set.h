// SPDX-License-Identifier: Apache-2.0
// What programs read that turn a whole picture into another: C++ and GLSL.
#ifndef LUXO_SHARED_PICTURE_SET_H
#define LUXO_SHARED_PICTURE_SET_H
#include "shared/types.h"

#ifdef __cplusplus
namespace luxo::shared {
#endif

LUXO_CONSTANT kSetPicture = 0;
LUXO_CONSTANT kBindingPicture = 0;
LUXO_CONSTANT kConstantUncertain = 0;  // of a mean: added to how good a point is where nothing is certain

#ifdef __cplusplus
}  // namespace luxo::shared
#endif
#endif
