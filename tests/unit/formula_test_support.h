// SPDX-License-Identifier: Apache-2.0
// Formulas that the tests of engine/formula share: random programs that run on any kind of number, and dual
// numbers that differentiate them without the engine.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "formula/expression.h"

namespace luxo {

/// Forward-mode automatic differentiation, written for the tests alone: Dual<Dual<T>> gives second
/// derivatives.
template <class T>
struct Dual {
  T value{}, slope{};

  Dual() = default;
  Dual(double constant) : value(constant), slope(0) {}  // NOLINT: numbers are duals
  Dual(T v, T s) : value(v), slope(s) {}

  friend Dual operator-(Dual x) { return {-x.value, -x.slope}; }
  friend Dual operator+(Dual x, Dual y) { return {x.value + y.value, x.slope + y.slope}; }
  friend Dual operator-(Dual x, Dual y) { return {x.value - y.value, x.slope - y.slope}; }
  friend Dual operator*(Dual x, Dual y) { return {x.value * y.value, x.slope * y.value + x.value * y.slope}; }
  friend Dual operator/(Dual x, Dual y) {
    return {x.value / y.value, (x.slope * y.value - x.value * y.slope) / (y.value * y.value)};
  }
};

// What the engine's operations mean, for numbers without them.
inline long double power(long double x, int n) {
  long double product = 1;
  for (int i = 0; i < std::abs(n); ++i) product *= x;
  return n < 0 ? 1 / product : product;
}
inline Expr power(Expr x, int n) { return pow(x, n); }
inline long double sign(long double x) { return x > 0 ? 1 : x < 0 ? -1 : x; }
inline long double min(long double x, long double y) { return y < x || std::isnan(y) ? y : x; }
inline long double max(long double x, long double y) { return y > x || std::isnan(y) ? y : x; }
inline long double less(long double x, long double y) { return x < y ? 1 : 0; }
inline long double lessEqual(long double x, long double y) { return x <= y ? 1 : 0; }
inline long double equal(long double x, long double y) { return x == y ? 1 : 0; }
inline long double select(long double c, long double x, long double y) { return c != 0 ? x : y; }

/// sin(sqrt w) / sqrt w, and -2 times the derivative of one order is the next: by that recurrence, and near 0
/// by the series.
inline long double cardinal(long double w, int order) {
  if (std::abs(w) < 9) {
    long double term = 1, all = 0;
    for (int n = 1; n <= order; ++n) term /= 2 * n + 1;
    for (int k = 1; k <= 40; term *= -w / (2 * k * (2 * order + 2 * k + 1)), ++k) all += term;
    return all;
  }
  const long double x = std::sqrt(std::abs(w));
  long double below = w > 0 ? std::cos(x) : std::cosh(x), here = (w > 0 ? std::sin(x) : std::sinh(x)) / x;
  for (int n = 0; n < order; ++n) below = std::exchange(here, ((2 * n + 1) * here - below) / w);
  return here;
}

inline long double valueOf(long double x) { return x; }
template <class T>
long double valueOf(const Dual<T>& x) {
  return valueOf(x.value);
}

// Each function with its derivative; the unqualified calls find the functions of T, dual or not.
#define LUXO_TEST_DUAL(function, derivative)          \
  template <class T>                                  \
  Dual<T> function(Dual<T> dual) {                    \
    using std::abs, std::acos, std::asin, std::atan;  \
    using std::cos, std::cosh, std::exp, std::floor;  \
    using std::log, std::sin, std::sinh;              \
    using std::sqrt, std::tan, std::tanh;             \
    const T x = dual.value;                           \
    return {function(x), T(derivative) * dual.slope}; \
  }
LUXO_TEST_DUAL(sqrt, T(0.5) / sqrt(x))
LUXO_TEST_DUAL(exp, exp(x))
LUXO_TEST_DUAL(log, T(1) / x)
LUXO_TEST_DUAL(sin, cos(x))
LUXO_TEST_DUAL(cos, -sin(x))
LUXO_TEST_DUAL(tan, T(1) / (cos(x) * cos(x)))
LUXO_TEST_DUAL(asin, T(1) / sqrt(T(1) - x * x))
LUXO_TEST_DUAL(acos, T(-1) / sqrt(T(1) - x * x))
LUXO_TEST_DUAL(atan, T(1) / (T(1) + x * x))
LUXO_TEST_DUAL(sinh, cosh(x))
LUXO_TEST_DUAL(cosh, sinh(x))
LUXO_TEST_DUAL(tanh, T(1) / (cosh(x) * cosh(x)))
LUXO_TEST_DUAL(abs, sign(valueOf(x)))
LUXO_TEST_DUAL(floor, 0)
LUXO_TEST_DUAL(sign, 0)
#undef LUXO_TEST_DUAL

template <class T>
Dual<T> power(Dual<T> x, int n) {
  return {power(x.value, n), n == 0 ? T(0) : T(n) * power(x.value, n - 1) * x.slope};
}
template <class T>
Dual<T> cardinal(Dual<T> x, int order) {
  return {cardinal(x.value, order), T(-0.5) * cardinal(x.value, order + 1) * x.slope};
}
template <class T>
Dual<T> pow(Dual<T> x, Dual<T> y) {
  using std::log, std::pow;
  const T byBase = y.value * pow(x.value, y.value - T(1)), byExponent = pow(x.value, y.value) * log(x.value);
  return {pow(x.value, y.value), byBase * x.slope + byExponent * y.slope};
}
template <class T>
Dual<T> atan2(Dual<T> y, Dual<T> x) {
  using std::atan2;
  return {atan2(y.value, x.value),
          (x.value * y.slope - y.value * x.slope) / (x.value * x.value + y.value * y.value)};
}
template <class T>
Dual<T> min(Dual<T> x, Dual<T> y) {
  return valueOf(y) < valueOf(x) ? y : x;
}
template <class T>
Dual<T> max(Dual<T> x, Dual<T> y) {
  return valueOf(y) > valueOf(x) ? y : x;
}
template <class T>
Dual<T> less(Dual<T> x, Dual<T> y) {
  return valueOf(x) < valueOf(y) ? 1 : 0;
}
template <class T>
Dual<T> lessEqual(Dual<T> x, Dual<T> y) {
  return valueOf(x) <= valueOf(y) ? 1 : 0;
}
template <class T>
Dual<T> equal(Dual<T> x, Dual<T> y) {
  return valueOf(x) == valueOf(y) ? 1 : 0;
}
template <class T>
Dual<T> select(Dual<T> c, Dual<T> x, Dual<T> y) {
  return valueOf(c) != 0 ? x : y;
}

/// A formula as a list of operations on earlier results; inputs are u, v and one parameter.
class RandomFormula {
 public:
  /// With `smooth` every operation stays inside its domain and away from singularities and overflow; kinks
  /// and jumps remain.
  RandomFormula(std::mt19937_64& random, int operations, bool smooth) : random_(random), smooth_(smooth) {
    for (std::uint32_t i = 0; i < 3; ++i) add({.op = Op::Variable, .a = i});
    while (static_cast<int>(steps_.size()) < operations + 3) addOperation();
  }

  /// Runs on any kind of number that has the operations.
  template <class T>
  [[nodiscard]] T operator()(T u, T v, T parameter) const {
    using std::abs, std::acos, std::asin, std::atan, std::atan2, std::cos, std::cosh, std::exp, std::floor,
        std::log, std::pow, std::sin, std::sinh, std::sqrt, std::tan, std::tanh;
    std::vector<T> r{u, v, parameter};
    for (std::size_t i = 3; i < steps_.size(); ++i) {
      const Step& s = steps_[i];
      switch (s.op) {
        case Op::Constant:
          r.push_back(T(s.value));
          break;
        case Op::Negate:
          r.push_back(-r[s.a]);
          break;
        case Op::Add:
          r.push_back(r[s.a] + r[s.b]);
          break;
        case Op::Subtract:
          r.push_back(r[s.a] - r[s.b]);
          break;
        case Op::Multiply:
          r.push_back(r[s.a] * r[s.b]);
          break;
        case Op::Divide:
          r.push_back(r[s.a] / r[s.b]);
          break;
        case Op::Power:
          r.push_back(power(r[s.a], s.exponent));
          break;
        case Op::Sqrt:
          r.push_back(sqrt(r[s.a]));
          break;
        case Op::Exp:
          r.push_back(exp(r[s.a]));
          break;
        case Op::Log:
          r.push_back(log(r[s.a]));
          break;
        case Op::Sin:
          r.push_back(sin(r[s.a]));
          break;
        case Op::Cos:
          r.push_back(cos(r[s.a]));
          break;
        case Op::Tan:
          r.push_back(tan(r[s.a]));
          break;
        case Op::Sinh:
          r.push_back(sinh(r[s.a]));
          break;
        case Op::Cosh:
          r.push_back(cosh(r[s.a]));
          break;
        case Op::Tanh:
          r.push_back(tanh(r[s.a]));
          break;
        case Op::Asin:
          r.push_back(asin(r[s.a]));
          break;
        case Op::Acos:
          r.push_back(acos(r[s.a]));
          break;
        case Op::Atan:
          r.push_back(atan(r[s.a]));
          break;
        case Op::Abs:
          r.push_back(abs(r[s.a]));
          break;
        case Op::Floor:
          r.push_back(floor(r[s.a]));
          break;
        case Op::Sign:
          r.push_back(sign(r[s.a]));
          break;
        case Op::Atan2:
          r.push_back(atan2(r[s.a], r[s.b]));
          break;
        case Op::Min:
          r.push_back(min(r[s.a], r[s.b]));
          break;
        case Op::Max:
          r.push_back(max(r[s.a], r[s.b]));
          break;
        case Op::Raise:
          r.push_back(pow(r[s.a], r[s.b]));
          break;
        case Op::Less:
          r.push_back(less(r[s.a], r[s.b]));
          break;
        case Op::LessEqual:
          r.push_back(lessEqual(r[s.a], r[s.b]));
          break;
        case Op::Equal:
          r.push_back(equal(r[s.a], r[s.b]));
          break;
        case Op::Select:
          r.push_back(select(r[s.a], r[s.b], r[s.c]));
          break;
        case Op::Cardinal:
          r.push_back(cardinal(r[s.a], s.exponent));
          break;
        case Op::Variable:
          break;
      }
    }
    return r.back();
  }

 private:
  struct Step {
    Op op = Op::Constant;
    std::uint32_t a = 0, b = 0, c = 0;
    double value = 0;
    int exponent = 0;
  };

  /// Any varying result; late ones are likelier, so that formulas grow deep.
  std::uint32_t any() {
    const std::size_t n = varying_.size();
    return varying_[std::max(random_() % n, random_() % n)];
  }
  std::uint32_t add(const Step& step) {
    const auto index = static_cast<std::uint32_t>(steps_.size());
    steps_.push_back(step);
    if (step.op != Op::Constant) varying_.push_back(index);
    return index;
  }
  /// Quarters: the engine folds products and sums of constants, and those of quarters are exact.
  std::uint32_t constant() {
    return add({.op = Op::Constant,
                .value = (1 + static_cast<double>(random_() % 8)) * (random_() % 2 ? 0.25 : -0.25)});
  }
  /// x^2 + 1/2: fit for a root, a logarithm, a denominator.
  std::uint32_t positive(std::uint32_t x) {
    const std::uint32_t squared = add({.op = Op::Multiply, .a = x, .b = x});
    const std::uint32_t half = add({.op = Op::Constant, .value = 0.5});
    return add({.op = Op::Add, .a = squared, .b = half});
  }
  std::uint32_t bounded(std::uint32_t x) { return add({.op = Op::Sin, .a = x}); }
  /// sin(x) / 2: fit for an arc sine, away from its ends.
  std::uint32_t half(std::uint32_t x) {
    const std::uint32_t part = add({.op = Op::Constant, .value = 0.5});
    return add({.op = Op::Multiply, .a = bounded(x), .b = part});
  }

  void addOperation() {
    const auto op = static_cast<Op>(random_() % (static_cast<int>(Op::Select) + 1));
    Step step{.op = op, .a = any(), .b = any(), .c = any(), .exponent = 1 + static_cast<int>(random_() % 5)};
    if (op == Op::Variable) return;
    if (op == Op::Constant) {
      const Op with[] = {Op::Add, Op::Subtract, Op::Multiply};
      step.op = with[random_() % 3];
      step.b = constant();
    }
    if (smooth_) {
      if (op == Op::Sqrt || op == Op::Log || op == Op::Raise) step.a = positive(step.a);
      if (op == Op::Divide || op == Op::Atan2) step.b = positive(step.b);
      if (op == Op::Exp || op == Op::Sinh || op == Op::Cosh || op == Op::Tan || op == Op::Power)
        step.a = bounded(step.a);
      if (op == Op::Raise) step.b = bounded(step.b);
      if (op == Op::Asin || op == Op::Acos) step.a = half(step.a);
    } else if (random_() % 4 == 0) {
      step.exponent = -step.exponent;
    }
    add(step);
  }

  std::mt19937_64& random_;
  bool smooth_;
  std::vector<Step> steps_;
  std::vector<std::uint32_t> varying_;  ///< steps that are not constants
};

}  // namespace luxo
