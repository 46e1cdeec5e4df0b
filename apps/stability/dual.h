// SPDX-License-Identifier: Apache-2.0
// Numbers that carry their derivatives along u and v by the rules of each operation, in long double: how
// formulas are differentiated without any expression being differentiated, eleven bits finer than double.
#pragma once

#include <cmath>
#include <vector>

#include "formula/expression.h"

namespace luxo {

struct Dual {
  long double value = 0, du = 0, dv = 0;

  Dual() = default;
  Dual(long double constant) : value(constant) {}  // NOLINT: a number is one that does not change
  Dual(long double x, long double xu, long double xv) : value(x), du(xu), dv(xv) {}
};

/// f(x), with f' there.
[[nodiscard]] inline Dual chain(const Dual& x, long double value, long double slope) {
  return {value, slope * x.du, slope * x.dv};
}

[[nodiscard]] inline Dual operator-(const Dual& x) { return {-x.value, -x.du, -x.dv}; }
[[nodiscard]] inline Dual operator+(const Dual& x, const Dual& y) {
  return {x.value + y.value, x.du + y.du, x.dv + y.dv};
}
[[nodiscard]] inline Dual operator-(const Dual& x, const Dual& y) { return x + -y; }
[[nodiscard]] inline Dual operator*(const Dual& x, const Dual& y) {
  return {x.value * y.value, x.du * y.value + x.value * y.du, x.dv * y.value + x.value * y.dv};
}
[[nodiscard]] inline Dual operator/(const Dual& x, const Dual& y) {
  const long double quotient = x.value / y.value;
  return {quotient, (x.du - quotient * y.du) / y.value, (x.dv - quotient * y.dv) / y.value};
}

[[nodiscard]] inline Dual integerPower(const Dual& x, int n) {
  return n == 0 ? Dual(1) : chain(x, std::pow(x.value, n), n * std::pow(x.value, n - 1));
}
[[nodiscard]] inline Dual sqrt(const Dual& x) {
  const long double root = std::sqrt(x.value);
  return chain(x, root, 1 / (2 * root));
}
/// engine/math/cardinal.h, here by its definition: the quotient and, near 0, the series.
[[nodiscard]] inline long double cardinal(long double w, int order) {
  if (order > 0 && std::abs(w) > 9)  // x f' = (cos x - f) / 2 with w = x^2, and so on upwards
    return ((2 * order - 1) * cardinal(w, order - 1) -
            (order == 1 ? (w > 0 ? std::cos(std::sqrt(w)) : std::cosh(std::sqrt(-w)))
                        : cardinal(w, order - 2))) /
           w;
  if (order == 0 && w > 9) return std::sin(std::sqrt(w)) / std::sqrt(w);
  if (order == 0 && w < -9) return std::sinh(std::sqrt(-w)) / std::sqrt(-w);
  long double term = 1, sum = 0;
  for (int n = 1; n <= order; ++n) term /= 2 * n + 1;
  for (int k = 1; k <= 40; term *= -w / (2 * k * (2 * order + 2 * k + 1)), ++k) sum += term;
  return sum;
}
[[nodiscard]] inline Dual cardinal(const Dual& x, int order) {
  return chain(x, cardinal(x.value, order), -cardinal(x.value, order + 1) / 2);
}
[[nodiscard]] inline Dual exp(const Dual& x) { return chain(x, std::exp(x.value), std::exp(x.value)); }
[[nodiscard]] inline Dual log(const Dual& x) { return chain(x, std::log(x.value), 1 / x.value); }
[[nodiscard]] inline Dual sin(const Dual& x) { return chain(x, std::sin(x.value), std::cos(x.value)); }
[[nodiscard]] inline Dual cos(const Dual& x) { return chain(x, std::cos(x.value), -std::sin(x.value)); }
[[nodiscard]] inline Dual tan(const Dual& x) {
  const long double t = std::tan(x.value);
  return chain(x, t, 1 + t * t);
}
[[nodiscard]] inline Dual sinh(const Dual& x) { return chain(x, std::sinh(x.value), std::cosh(x.value)); }
[[nodiscard]] inline Dual cosh(const Dual& x) { return chain(x, std::cosh(x.value), std::sinh(x.value)); }
[[nodiscard]] inline Dual tanh(const Dual& x) {
  const long double c = std::cosh(x.value);
  return chain(x, std::tanh(x.value), 1 / (c * c));
}
[[nodiscard]] inline Dual asin(const Dual& x) {
  return chain(x, std::asin(x.value), 1 / std::sqrt(1 - x.value * x.value));
}
[[nodiscard]] inline Dual acos(const Dual& x) {
  return chain(x, std::acos(x.value), -1 / std::sqrt(1 - x.value * x.value));
}
[[nodiscard]] inline Dual atan(const Dual& x) {
  return chain(x, std::atan(x.value), 1 / (1 + x.value * x.value));
}
[[nodiscard]] inline Dual atan2(const Dual& y, const Dual& x) {
  const long double square = x.value * x.value + y.value * y.value;
  return {std::atan2(y.value, x.value), (x.value * y.du - y.value * x.du) / square,
          (x.value * y.dv - y.value * x.dv) / square};
}
[[nodiscard]] inline Dual pow(const Dual& x, const Dual& y) {
  const long double power = std::pow(x.value, y.value), slope = y.value * std::pow(x.value, y.value - 1);
  // Where the exponent stands still the logarithm has no say, whatever the sign of the base.
  const long double growth = y.du == 0 && y.dv == 0 ? 0 : power * std::log(x.value);
  return {power, slope * x.du + growth * y.du, slope * x.dv + growth * y.dv};
}
[[nodiscard]] inline Dual abs(const Dual& x) { return x.value < 0 ? -x : x; }
[[nodiscard]] inline Dual min(const Dual& x, const Dual& y) { return x.value < y.value ? x : y; }
[[nodiscard]] inline Dual max(const Dual& x, const Dual& y) { return x.value > y.value ? x : y; }
[[nodiscard]] inline Dual floor(const Dual& x) { return std::floor(x.value); }
[[nodiscard]] inline Dual sign(const Dual& x) {
  return static_cast<long double>(x.value > 0) - static_cast<long double>(x.value < 0);
}
[[nodiscard]] inline Dual less(const Dual& x, const Dual& y) { return x.value < y.value ? 1.0L : 0.0L; }
[[nodiscard]] inline Dual lessEqual(const Dual& x, const Dual& y) { return x.value <= y.value ? 1.0L : 0.0L; }
[[nodiscard]] inline Dual equal(const Dual& x, const Dual& y) { return x.value == y.value ? 1.0L : 0.0L; }
[[nodiscard]] inline Dual select(const Dual& condition, const Dual& a, const Dual& b) {
  return condition.value != 0 ? a : b;
}

/// A list of expressions, evaluated one point at a time.
class DualFormula {
 public:
  DualFormula(Graph& graph, const std::vector<Expr>& outputs);

  /// The outputs at (u, v); `inputs` are variables 2, 3, ...
  [[nodiscard]] std::vector<Dual> at(double u, double v, const std::vector<double>& inputs) const;

 private:
  std::vector<ExprNode> nodes_;         // those needed, renumbered
  std::vector<std::uint32_t> outputs_;  // indices into them
};

}  // namespace luxo
