// SPDX-License-Identifier: Apache-2.0
// Interval arithmetic in double with outward rounding: the true result of the real operation, over every
// point of the operands, lies inside the returned interval. Inclusion is what makes a bound a proof.
//
// Rounding: + - * / and sqrt are correctly rounded, so one step outward suffices; the C library's elementary
// functions are within 1 ulp (glibc manual, "Errors in Math Functions": at most 2 for cosh, sinh, tanh), so
// they take four. An operation outside its domain (1/0, log of a negative) returns the whole line, never NaN.
#pragma once

#include <limits>

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
[[nodiscard]] Interval tan(const Interval& x);
[[nodiscard]] Interval sinh(const Interval& x);
[[nodiscard]] Interval cosh(const Interval& x);
[[nodiscard]] Interval tanh(const Interval& x);

}  // namespace luxo
