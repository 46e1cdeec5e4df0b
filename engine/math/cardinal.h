// SPDX-License-Identifier: Apache-2.0
// The cardinal sine of a square root and its derivatives: what sin(x) / x is made of, without the quotient.
//
//     cardinal(w, 0) = sin(sqrt w) / sqrt w = 1 - w/6 + w^2/120 - ...
//
// It has no singularity: it is one power series in w, which for negative w is that of sinh(x) / x. With
// spherical Bessel functions cardinal(w, n) = j_n(sqrt w) / sqrt(w)^n, and d cardinal(w, n) / dw =
// -cardinal(w, n + 1) / 2 (Abramowitz and Stegun 10.1.2, 10.1.24): the family holds its own derivatives.
#pragma once

#include "math/interval.h"
#include "math/partial_interval.h"

namespace luxo {

/// The largest value that positive w have: 1 / (1 * 3 * 5 * ... * (2 order + 1)), at 0.
[[nodiscard]] double cardinalAtZero(int order);

/// For positive w wrong by at most 1e-13 * cardinalAtZero(order), else by that part of the result; orders up
/// to 6 (measured: 2e-14; order 0, 3e-16). Infinite where it overflows.
[[nodiscard]] double cardinal(double w, int order);
/// Where w <= 20 all orders fall as w grows, so the ends decide; beyond, the mean value theorem and the
/// envelope of j_n: x^2 (j_n^2 + y_n^2) is a polynomial in 1/x (10.1.27).
[[nodiscard]] Interval cardinal(const Interval& w, int order);
[[nodiscard]] PartialInterval cardinal(const PartialInterval& w, int order);

}  // namespace luxo
