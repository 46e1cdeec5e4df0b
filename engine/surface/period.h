// SPDX-License-Identifier: Apache-2.0
// Whether a patch's formula goes on beyond an edge as it does at the other end.
#pragma once

#include <span>

#include "surface/patch.h"

namespace luxo {

/// Whether the formula has the domain's width in u (in v) as a period, to a thousandth of a turn: by how it
/// is written (formula/degree.h), at these parameter values. Cost: linear in its operations.
[[nodiscard]] bool hasPeriod(const Patch& patch, std::span<const double> parameters, bool alongU);

}  // namespace luxo
