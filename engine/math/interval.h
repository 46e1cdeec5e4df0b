// SPDX-License-Identifier: Apache-2.0
// Interval arithmetic in double with outward rounding: the true result of the real operation, over every
// point of the operands, lies inside the returned interval, and so does the result in double. Inclusion is
// what makes a bound a proof.
//
// Rounding: + - * / and sqrt are correctly rounded, so one step outward suffices, and none where they are
// exact; the C library's elementary functions are within 1 ulp (glibc manual, "Errors in Math Functions": at
// most 2 for cosh, sinh, tanh), so they take four.
//
// everything() means that the result may be anything, undefined (NaN) included: it is what an operation gives
// that leaves its domain anywhere (1/0, log of a negative), and what every function gives of it. So a bounded
// result proves that all of it is defined. Only select() forgets it, where it is not chosen. NaN never comes
// out.
#pragma once

#include "math/numbers.h"

namespace luxo {

struct Interval {
  double lo = 0, hi = 0;

  constexpr Interval() = default;
  constexpr Interval(double point) : lo(point), hi(point) {}  // NOLINT: a number is an interval
  constexpr Interval(double low, double high) : lo(low), hi(high) {}

  [[nodiscard]] static constexpr Interval everything() {
    return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  }
  [[nodiscard]] constexpr double mid() const { return lo + 0.5 * (hi - lo); }
  [[nodiscard]] constexpr double width() const { return hi - lo; }
  [[nodiscard]] constexpr bool contains(double x) const { return lo <= x && x <= hi; }
  /// Largest |x| of the interval.
  [[nodiscard]] constexpr double magnitude() const { return -lo > hi ? -lo : hi; }

  friend constexpr bool operator==(const Interval&, const Interval&) = default;
};

[[nodiscard]] Interval operator-(const Interval& x);
[[nodiscard]] Interval operator+(const Interval& x, const Interval& y);
[[nodiscard]] Interval operator-(const Interval& x, const Interval& y);
[[nodiscard]] Interval operator*(const Interval& x, const Interval& y);
[[nodiscard]] Interval operator/(const Interval& x, const Interval& y);

[[nodiscard]] Interval hull(const Interval& x, const Interval& y);
[[nodiscard]] Interval square(const Interval& x);
[[nodiscard]] Interval pow(const Interval& x, int exponent);
[[nodiscard]] Interval sqrt(const Interval& x);
[[nodiscard]] Interval exp(const Interval& x);
[[nodiscard]] Interval log(const Interval& x);
[[nodiscard]] Interval sin(const Interval& x);
[[nodiscard]] Interval cos(const Interval& x);
void sinCos(const Interval& x, Interval& sine, Interval& cosine);
[[nodiscard]] Interval tan(const Interval& x);
[[nodiscard]] Interval sinh(const Interval& x);
[[nodiscard]] Interval cosh(const Interval& x);
[[nodiscard]] Interval tanh(const Interval& x);
[[nodiscard]] Interval asin(const Interval& x);
[[nodiscard]] Interval acos(const Interval& x);
[[nodiscard]] Interval atan(const Interval& x);
[[nodiscard]] Interval atan2(const Interval& y, const Interval& x);
[[nodiscard]] Interval abs(const Interval& x);
[[nodiscard]] Interval min(const Interval& x, const Interval& y);
[[nodiscard]] Interval max(const Interval& x, const Interval& y);
[[nodiscard]] Interval floor(const Interval& x);
[[nodiscard]] Interval sign(const Interval& x);
/// x^y as std::pow has it.
[[nodiscard]] Interval pow(const Interval& x, const Interval& y);
[[nodiscard]] inline Interval pow(const Interval& x, double y) { return pow(x, Interval(y)); }
/// 1, 0 or, where both are possible, [0, 1].
[[nodiscard]] Interval less(const Interval& x, const Interval& y);
[[nodiscard]] Interval lessEqual(const Interval& x, const Interval& y);
[[nodiscard]] Interval equal(const Interval& x, const Interval& y);
/// What a choice may give; the alternative that no condition chooses does not count.
[[nodiscard]] Interval select(const Interval& condition, const Interval& a, const Interval& b);

}  // namespace luxo
