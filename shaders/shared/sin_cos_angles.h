// SPDX-License-Identifier: Apache-2.0
// The angles at which sin and cos are measured: columns * rows of them, with 0 in the middle.
#ifndef LUXO_SHARED_SIN_COS_ANGLES_H
#define LUXO_SHARED_SIN_COS_ANGLES_H
#include "shared/types.h"

#ifdef __cplusplus
namespace luxo::shared {
#endif

LUXO_CONSTANT kAngleColumns = 128;
LUXO_CONSTANT kAngleRows = 64;
LUXO_NUMBER kAngleStep = 7.66990393e-4;  // pi / 4096

#ifdef __cplusplus
}  // namespace luxo::shared
#endif
#endif
