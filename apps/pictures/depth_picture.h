// SPDX-License-Identifier: Apache-2.0
// Depths as a grey picture, as lessons on depth maps show them.
#pragma once

#include <optional>

#include "image/image.h"
#include "math/interval.h"

namespace luxo {

/// Of the finite ones in a picture of one channel; nothing where there is none.
[[nodiscard]] std::optional<Interval> depthsIn(const Image& depths);

/// For files of 8-bit codes, which fall evenly from white where it is nearest to 1/8 of that where it is
/// farthest, and no further beyond the range; black where there is nothing.
[[nodiscard]] Image greyDepths(Image depths, const Interval& range);

}  // namespace luxo
