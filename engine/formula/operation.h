// SPDX-License-Identifier: Apache-2.0
// What each operation does to numbers: one definition for constants, batches and intervals. Outside its
// domain an operation on doubles is NaN or infinite, one on intervals is everything().
#pragma once

#include <cmath>
#include <concepts>

#include "base/assert.h"
#include "formula/expression.h"
#include "math/cardinal.h"
#include "math/interval.h"
#include "math/partial_interval.h"

namespace luxo {

/// x^n by repeated squaring: the same rounding wherever it is evaluated.
template <std::floating_point Number>
[[nodiscard]] Number integerPower(Number x, int n) {
  if (n < 0) return 1 / integerPower(x, -n);
  Number result = 1;
  for (; n > 0; n >>= 1, x *= x)
    if (n & 1) result *= x;
  return result;
}

[[nodiscard]] inline Interval integerPower(const Interval& x, int n) { return pow(x, n); }

/// The operations on doubles that the standard library does not have, or has without passing on NaN.
namespace number {

[[nodiscard]] inline double min(double x, double y) {
  const double least = x < y ? x : y;
  return x == x ? least : x;
}
[[nodiscard]] inline double max(double x, double y) {
  const double largest = x > y ? x : y;
  return x == x ? largest : x;
}
[[nodiscard]] inline double sign(double x) { return x > 0 ? 1 : x < 0 ? -1 : x == 0 ? 0 : x; }
[[nodiscard]] inline double less(double x, double y) { return x < y ? 1 : 0; }
[[nodiscard]] inline double lessEqual(double x, double y) { return x <= y ? 1 : 0; }
[[nodiscard]] inline double equal(double x, double y) { return x == y ? 1 : 0; }
[[nodiscard]] inline double select(double condition, double a, double b) { return condition != 0 ? a : b; }

}  // namespace number

/// Sine and cosine of one angle, which together cost little more than one.
template <std::floating_point Number>
inline void sinCos(Number x, Number& sine, Number& cosine) {
  const Number s = std::sin(x), c = std::cos(x);
  sine = s;
  cosine = c;
}

/// The value of one operation; `Number` is double, float, Interval or PartialInterval. (What
/// is computed in double for a float is rounded once.)
template <class Number>
[[nodiscard]] Number operate(Op op, const Number& x, const Number& y, const Number& z, int exponent) {
  using number::min, number::max, number::sign, number::less, number::lessEqual, number::equal,
      number::select;
  using std::abs, std::acos, std::asin, std::atan, std::atan2, std::cos, std::cosh, std::exp, std::floor,
      std::log, std::pow, std::sin, std::sinh, std::sqrt, std::tan, std::tanh;
  switch (op) {
    case Op::Negate:
      return -x;
    case Op::Add:
      return x + y;
    case Op::Subtract:
      return x - y;
    case Op::Multiply:
      return x * y;
    case Op::Divide:
      return x / y;
    case Op::Power:
      return integerPower(x, exponent);
    case Op::Raise:
      return pow(x, y);
    case Op::Sqrt:
      return sqrt(x);
    case Op::Exp:
      return exp(x);
    case Op::Log:
      return log(x);
    case Op::Sin:
      return sin(x);
    case Op::Cos:
      return cos(x);
    case Op::Tan:
      return tan(x);
    case Op::Asin:
      return asin(x);
    case Op::Acos:
      return acos(x);
    case Op::Atan:
      return atan(x);
    case Op::Atan2:
      return atan2(x, y);
    case Op::Sinh:
      return sinh(x);
    case Op::Cosh:
      return cosh(x);
    case Op::Tanh:
      return tanh(x);
    case Op::Abs:
      return abs(x);
    case Op::Min:
      return min(x, y);
    case Op::Max:
      return max(x, y);
    case Op::Floor:
      return floor(x);
    case Op::Sign:
      return sign(x);
    case Op::Less:
      return less(x, y);
    case Op::LessEqual:
      return lessEqual(x, y);
    case Op::Equal:
      return equal(x, y);
    case Op::Select:
      return select(x, y, z);
    case Op::Cardinal:
      return cardinal(x, exponent);
    case Op::Constant:
    case Op::Variable:
      break;
  }
  LUXO_REQUIRE(false && "an operation");
  return {};
}

}  // namespace luxo
