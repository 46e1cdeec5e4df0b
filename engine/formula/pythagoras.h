// SPDX-License-Identifier: Apache-2.0
// sin^2 x + cos^2 x = 1 in sums of products, as lengths of what turns around an axis have them: intervals of
// the sum are wide, and that of 1 is not.
#pragma once

#include "formula/expression.h"

namespace luxo {

/// The sum with k sin^2 x + k cos^2 x written as k, whatever k is, its numbers the same but for rounding. The
/// same formula where there is none. Cost: quadratic in the terms, of which there are 32 at most.
[[nodiscard]] Expr withoutSquaresOfTurns(Graph& graph, Expr sum);

}  // namespace luxo
