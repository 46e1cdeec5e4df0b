// SPDX-License-Identifier: Apache-2.0
// How often a formula can turn: its degree, of formulas that have one, and whether it is periodic. Both
// follow from how it is written, not from what it is here and there.
//
// Sums of products of powers of u and v and of sines and cosines of linear functions of them have one: the
// largest power of a variable, plus the whole turns that such a function makes over the domain. Of sums it is
// the larger one, of products the sum; square roots count as what is under them. Exponentials, quotients,
// absolute values and the like have none.
//
// Nothing of a function of low degree is narrow: its slope, times the width of the domain, is at most 2 pi d
// times its size, of a polynomial 2 d^2 times (the inequalities of S. Bernstein, 1912, and A. Markov, 1889).
// So what it is at places close together it is between them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "formula/expression.h"
#include "math/vec.h"

namespace luxo {

/// Of each root, in u and in v (variables 0 and 1); infinite where it has none, and in both where it reads
/// other variables. `width`: of the domain. Cost: linear in the nodes that the roots need.
[[nodiscard]] std::vector<Vec2> degreesOf(Graph& graph, std::span<const Expr> roots, const Vec2& width);

/// Whether all roots have a period in a variable (0 or 1), of which `width` is a multiple, or a thousandth of
/// a turn beside one: it is read in sines, cosines and tangents of linear functions alone. Variables from 2
/// on count as constant. Cost: as above.
[[nodiscard]] bool isPeriodic(Graph& graph, std::span<const Expr> roots, int variable, double width);

}  // namespace luxo
