// SPDX-License-Identifier: Apache-2.0
// The real roots of polynomials of low degree, proven: quadratics by their formula, others by interval Newton
// (R. Moore 1966) on parts of the line.
#pragma once

#include <array>
#include <span>

#include "math/interval.h"

namespace luxo::reference {

/// A simple root.
struct RealRoot {
  Interval at;          ///< holds it and no other
  bool rising = false;  ///< the polynomial goes from - to + here
};

struct RealRoots {
  std::array<RealRoot, 4> roots;  ///< by ascending place
  int count = 0;
  bool decided = true;  ///< false: roots that touch within rounding; `roots` then means nothing

  [[nodiscard]] std::span<const RealRoot> all() const {
    return {roots.data(), static_cast<std::size_t>(count)};
  }
};

/// Of c[0] + c[1] x + c[2] x^2 + ..., up to degree 4, whatever the coefficients are in their intervals: every
/// root with |x| <= reach, and perhaps some beyond. Cost: a microsecond for a quadratic, some five for a
/// quartic.
[[nodiscard]] RealRoots realRoots(std::span<const Interval> coefficients, double reach);

}  // namespace luxo::reference
