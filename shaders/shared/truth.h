// SPDX-License-Identifier: Apache-2.0
// Numbers that pictures have in common with the truth that they are held against. That includes no shaders: it has its own, in
// double, where it is said why they are what they are, and draw/truth.cpp asserts that they are the same.
#ifndef LUXO_SHARED_TRUTH_H
#define LUXO_SHARED_TRUTH_H
#include "shared/types.h"

#ifdef __cplusplus
namespace luxo::shared {
#endif

// engine/reference/picture_rules.h.
LUXO_NUMBER kTurningAway = 0.35;
LUXO_NUMBER kDrawnBright = 0.5;
LUXO_NUMBER kDrawnShaded = 0.5;
LUXO_NUMBER kDrawnOutlinePx = 2.0;
LUXO_NUMBER kTransmittanceRounding = 4e-4;
LUXO_NUMBER kPatchSlack = 1e-3;  // of half a patch, not of a whole one

// engine/scene/isolines.h.
LUXO_NUMBER kFieldRounding = 1e-6;
LUXO_NUMBER kEndlessSlope = 1e30;
LUXO_NUMBER kFewLines = 3.0;
LUXO_NUMBER kManyLines = 4.0;

// engine/scene/texture_map.h.
LUXO_NUMBER kMaxTextureStep = 1e6;

#ifdef __cplusplus
}  // namespace luxo::shared
#endif
#endif
