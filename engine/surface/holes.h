// SPDX-License-Identifier: Apache-2.0
// Where a formula has no finite value.
#pragma once

#include <span>
#include <vector>

#include "surface/patch.h"

namespace luxo {

/// Rectangles of a patch's domain that hold everything found without a finite value, at most kMaxHoles, in
/// order of v, then u: the undefined points of a 65 x 65 grid, edges included, grouped by neighbourhood,
/// their sides moved out by bisection; and the places where the formula grows without bound, though no sample
/// hits them. What is thinner than a cell and neither is missed. Cost: one interval evaluation where there
/// cannot be any, else some 10,000 evaluations.
inline constexpr int kMaxHoles = 8;
[[nodiscard]] std::vector<Domain> findHoles(const Patch& patch, std::span<const double> inputs);

}  // namespace luxo
