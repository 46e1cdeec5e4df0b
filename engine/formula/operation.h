// SPDX-License-Identifier: Apache-2.0
// What each operation does to numbers: one definition for constants, batches and intervals.
#pragma once

#include <cmath>

#include "base/assert.h"
#include "formula/expression.h"
#include "math/interval.h"

namespace luxo {

/// x^n by repeated squaring: the same rounding wherever it is evaluated.
[[nodiscard]] inline double integerPower(double x, int n) {
  if (n < 0) return 1 / integerPower(x, -n);
  double result = 1;
  for (; n > 0; n >>= 1, x *= x)
    if (n & 1) result *= x;
  return result;
}

[[nodiscard]] inline Interval integerPower(const Interval& x, int n) { return pow(x, n); }

/// The value of one operation; `Number` is double or Interval.
template <class Number>
[[nodiscard]] Number operate(Op op, const Number& x, const Number& y, int exponent) {
  using std::cos, std::cosh, std::exp, std::log, std::sin, std::sinh, std::sqrt, std::tan, std::tanh;
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
    case Op::Sinh:
      return sinh(x);
    case Op::Cosh:
      return cosh(x);
    case Op::Tanh:
      return tanh(x);
    case Op::Constant:
    case Op::Variable:
      break;
  }
  LUXO_REQUIRE(false && "an operation");
  return {};
}

}  // namespace luxo
