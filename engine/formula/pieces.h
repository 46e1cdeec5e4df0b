// SPDX-License-Identifier: Apache-2.0
// The smooth pieces of a formula that has kinks or jumps. Where they lie on lines of constant u or of
// constant v, a rectangle is cut there, and on each part every choice that is made alike all over it is
// replaced by what it chooses: |u| is -u on one side of u = 0 and u on the other.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "formula/expression.h"
#include "math/interval.h"

namespace luxo {

/// More cuts than this are not made: a formula such as floor(1000 u) stays in one piece, with its kinks.
inline constexpr std::size_t kMaxCuts = 32;

/// Where, strictly inside `range`, the roots are kinked in variable `axis` (0 or 1) whatever the value of
/// every other variable is: ascending, to the last bit but one. Empty when there are more than kMaxCuts.
/// Cost: about 100 interval evaluations per cut.
[[nodiscard]] std::vector<double> kinkLines(Graph& graph, std::span<const Expr> roots, std::uint32_t axis,
                                            const Interval& range);

/// The roots as they are inside the rectangle u x v, its edges taken from inside. Choices that are not made
/// alike all over it stay choices.
[[nodiscard]] std::vector<Expr> pieceOf(Graph& graph, std::span<const Expr> roots, const Interval& u,
                                        const Interval& v);

}  // namespace luxo
