// SPDX-License-Identifier: Apache-2.0
// Removable singularities: sin(u)/u has no value at 0, and the limit there is 1. A formula goes on through
// such places as another one that is the same wherever the first has a value: the factor that makes the
// divisor 0 is divided out of both sides.
//
// What is divided are polynomials in u, v and whatever else the formula is made of, exactly or not at all;
// before, functions that are 0 somewhere show their factor:
//
//     sin a = a S(a^2)              sinh a = a S(-a^2)                 tan a = a S(a^2) / cos a
//     cos a = 1 - a^2 S(a^2/4)^2 / 2                                   cosh a = 1 + a^2 S(-a^2/4)^2 / 2
//     exp a = 1 + a exp(a/2) S(-a^2/4)                                 with S = cardinal(., 0),
//     math/cardinal.h
//
// So sin(r)/r with r = sqrt(u^2 + v^2) is S(u^2 + v^2), which is smooth and has bounds everywhere. Where a
// factor is hidden from this (u - v in sin(u) - sin(v)), the formula stays as it is.
#pragma once

#include <span>
#include <vector>

#include "formula/expression.h"

namespace luxo {

/// The roots, continued; the same expressions where nothing can be divided out. Poles and the borders of
/// roots and logarithms stay. Cost: linear in the nodes, times a constant for each quotient.
[[nodiscard]] std::vector<Expr> continued(Graph& graph, std::span<const Expr> roots);

}  // namespace luxo
