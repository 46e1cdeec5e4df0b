// SPDX-License-Identifier: Apache-2.0
// That pictures and the truth have the same numbers in common (shaders/shared/truth.h).
#include "shared/truth.h"
#include "reference/picture_rules.h"
#include "scene/isolines.h"
#include "scene/texture_map.h"

namespace luxo {

static_assert(shared::kTurningAway == float{reference::kTurningAway});
static_assert(shared::kDrawnBright == float{reference::kDrawnBright});
static_assert(shared::kDrawnShaded == float{reference::kDrawnShaded});
static_assert(shared::kDrawnOutlinePx == float{reference::kDrawnOutlinePx});
static_assert(shared::kTransmittanceRounding == float{reference::kTransmittanceRounding});
static_assert(shared::kPatchSlack / 2 <= reference::kPatchSlack, "a place of a picture is one of the truth");
static_assert(shared::kFieldRounding == float{kFieldRounding});
static_assert(shared::kEndlessSlope == float{kEndlessSlope});
static_assert(shared::kFewLines == float{kFewLines} && shared::kManyLines == float{kManyLines});
static_assert(shared::kMaxTextureStep == float{kMaxTextureStep});

}  // namespace luxo
