// SPDX-License-Identifier: Apache-2.0
// The angles at which sin and cos are measured: columns * rows of them, with 0 in the middle.
#ifndef LUXO_SHARED_SIN_COS_ANGLES_H
#define LUXO_SHARED_SIN_COS_ANGLES_H

#ifdef __cplusplus
#include <cstdint>
namespace luxo::shared {
#define LUXO_CONSTANT inline constexpr
using uint = std::uint32_t;
#else
#define LUXO_CONSTANT const
#endif

LUXO_CONSTANT uint kAngleColumns = 128;
LUXO_CONSTANT uint kAngleRows = 64;
LUXO_CONSTANT float kAngleStep = 7.66990393e-4;  // pi / 4096

#ifdef __cplusplus
#undef LUXO_CONSTANT
}  // namespace luxo::shared
#endif
#endif
