// SPDX-License-Identifier: Apache-2.0
// Every operation by itself: value, derivatives, bound.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "formula/tape.h"
#include "formula_test_support.h"

namespace luxo {
namespace {

using Real = long double;

Real mod(Real x, Real y) { return x - y * std::floor(x / y); }
Real clamp(Real x, Real lo, Real hi) { return min(max(x, lo), hi); }
Real mix(Real a, Real b, Real t) { return a * (1 - t) + b * t; }
Real smoothstep(Real a, Real b, Real x) {
  const Real t = clamp((x - a) / (b - a), 0, 1);
  return t * t * (3 - 2 * t);
}
Real notEqual(Real x, Real y) { return x != y ? 1 : 0; }

/// One formula of x for the engine and for long double, over a range where it is smooth.
struct OperationCase {
  std::string name;
  std::function<Expr(Expr)> engine;
  std::function<Real(Real)> precise;
  double lo, hi;
};

#define LUXO_TEST_CASE(lo, hi, ...)                                                              \
  OperationCase {                                                                                \
#__VA_ARGS__,                                                                                  \
        [](Expr x) -> Expr { return __VA_ARGS__; },                                                \
        [](Real x) -> Real {                                                                       \
          using std::sin, std::cos, std::tan, std::asin, std::acos, std::atan, std::atan2;         \
          using std::sinh, std::cosh, std::tanh, std::exp, std::log, std::sqrt, std::pow;          \
          using std::abs, std::floor;                                                              \
          return __VA_ARGS__;                                                                      \
        },                                                                                         \
        lo, hi \
  }

const std::vector<OperationCase>& cases() {
  static const std::vector<OperationCase> all{
      LUXO_TEST_CASE(-2, 2, -x),
      LUXO_TEST_CASE(-2, 2, x * x + 3 * x - x / 7),
      LUXO_TEST_CASE(0.5, 3, 1 / x),
      LUXO_TEST_CASE(0.5, 3, sqrt(x)),
      LUXO_TEST_CASE(-2, 2, exp(x)),
      LUXO_TEST_CASE(0.5, 3, log(x)),
      LUXO_TEST_CASE(-4, 4, sin(x)),
      LUXO_TEST_CASE(-4, 4, cos(x)),
      LUXO_TEST_CASE(-1, 1, tan(x)),
      LUXO_TEST_CASE(-0.75, 0.75, asin(x)),
      LUXO_TEST_CASE(-0.75, 0.75, acos(x)),
      LUXO_TEST_CASE(-3, 3, atan(x)),
      LUXO_TEST_CASE(-3, 3, atan2(x, 2)),
      LUXO_TEST_CASE(0.5, 3, atan2(-2, x)),
      LUXO_TEST_CASE(-3, -0.5, atan2(x, x * x - 4)),
      LUXO_TEST_CASE(-2, 2, sinh(x)),
      LUXO_TEST_CASE(-2, 2, cosh(x)),
      LUXO_TEST_CASE(-1, 1, tanh(x)),
      LUXO_TEST_CASE(0.5, 3, abs(x)),
      LUXO_TEST_CASE(-3, -0.5, abs(x * x * x)),
      LUXO_TEST_CASE(-3, -0.5, min(x * x, -x * x)),
      LUXO_TEST_CASE(-3, -0.5, max(x * x, -x * x)),
      LUXO_TEST_CASE(0.5, 0.75, floor(x) + x * floor(x + 2)),
      LUXO_TEST_CASE(0.5, 2, sign(x) * x * x + sign(-x) * x),
      LUXO_TEST_CASE(0.5, 3, pow(x, 2.5)),
      LUXO_TEST_CASE(0.5, 3, pow(x, -0.75)),
      LUXO_TEST_CASE(0.5, 3, pow(x, 7)),
      LUXO_TEST_CASE(-2, 2, pow(2, x)),
      LUXO_TEST_CASE(0.5, 3, pow(x, x)),
      LUXO_TEST_CASE(0.5, 3, pow(x, sin(x))),
      LUXO_TEST_CASE(0.5, 3, less(x, 4) * x * x + less(4, x) * x),
      LUXO_TEST_CASE(0.5, 3, lessEqual(x, 4) * sin(x)),
      LUXO_TEST_CASE(0.5, 3, equal(x, 4) * sin(x) + notEqual(x, 5) * cos(x)),
      LUXO_TEST_CASE(0.5, 3, select(less(x, 4), x * x, exp(x))),
      LUXO_TEST_CASE(0.5, 3, select(less(4, x), x * x, exp(x))),
      LUXO_TEST_CASE(0.25, 0.75, mod(x * x - 3, 2)),
      LUXO_TEST_CASE(0.5, 3, clamp(x * x, 0.125, 16)),
      LUXO_TEST_CASE(0.5, 3, mix(x * x, sin(x), x)),
      LUXO_TEST_CASE(-1, 1, smoothstep(-2, 3, x)),
      LUXO_TEST_CASE(-1, 1, exp(sin(3 * x)) / (2 + cos(x * x))),
      LUXO_TEST_CASE(0.5, 2, sqrt(x * x + pow(log(x + 2), 3)) * atan(tanh(x))),
      LUXO_TEST_CASE(0.5, 1.5, asin(x / 4) * acos(x / 4) + cosh(sqrt(x)) * sinh(1 / x)),
      LUXO_TEST_CASE(0.5, 2, pow(abs(sin(x)), 0.3) * sign(sin(x))),
      LUXO_TEST_CASE(-2, 2, cardinal(x, 0)),
      LUXO_TEST_CASE(-2, 2, cardinal(x * x - 3, 2) + cardinal(20 + x, 1) * cardinal(x + 40, 0)),
  };
  return all;
}

/// Romberg: halving steps from 2^-5, each column removing the next even power of the step. With five steps
/// the truncation is 2^-70 times the 11th Taylor coefficient, at most 2^22 where the nearest singularity is a
/// quarter away; rounding is 2^-64 / 2^-9 and, for the second difference, 2^-64 / 2^-18.
Real extrapolate(const std::function<Real(Real)>& difference) {
  std::vector<Real> row;
  for (int k = 0; k < 5; ++k) {
    std::vector<Real> next{difference(std::ldexp(Real(1), -5 - k))};
    Real scale = 1;
    for (const Real& above : row) next.push_back(next.back() + (next.back() - above) / ((scale *= 4) - 1));
    row = next;
  }
  return row.back();
}

TEST(Operation, ValuesAndDerivativesAgainstDifferences) {
  for (const OperationCase& c : cases()) {
    Graph graph;
    const Expr f = c.engine(graph.variable(0)), slope = graph.derivative(f, 0);
    const Expr outputs[] = {f, slope, graph.derivative(slope, 0)};
    const Tape tape(graph, outputs);
    for (int i = 0; i <= 64; ++i) {
      const double x = c.lo + 2 * 0x1p-5 + (c.hi - c.lo - 4 * 0x1p-5) * i / 64;
      const auto& g = c.precise;
      const Real first = extrapolate([&](Real h) { return (g(x + h) - g(x - h)) / (2 * h); });
      const Real second = extrapolate([&](Real h) { return (g(x + h) - 2 * g(x) + g(x - h)) / (h * h); });
      double values[3];
      tape.evaluatePoint(x, 0, {}, values);
      EXPECT_NEAR(values[0], double(g(x)), 1e-14 * (1 + std::abs(double(g(x))))) << c.name << " at " << x;
      EXPECT_NEAR(values[1], double(first), 1e-12 * (1 + std::abs(double(first)))) << c.name << "' at " << x;
      EXPECT_NEAR(values[2], double(second), 1e-9 * (1 + std::abs(double(second))))
          << c.name << "'' at " << x;
      Interval bounds[3];
      tape.bound(x, 0, {}, bounds);
      for (int k = 0; k < 3; ++k) {
        EXPECT_TRUE(bounds[k].contains(values[k])) << c.name << " at " << x;
        EXPECT_LE(bounds[k].width(), 1e-12 * (1 + std::abs(values[k]))) << c.name << " at " << x;
      }
    }
  }
}

TEST(Operation, DoublesLieInsideTheirBounds) {
  // What is drawn is computed in double: not only the exact value must lie inside the bound. A million points
  // of every case; a range wider than the smooth one, kinks, jumps and holes included.
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> place(-6, 6), size(-8, 2), part(0, 1);
  constexpr int kBoxes = 1'000, kPoints = 1'000;
  std::vector<double> parts(kPoints), us(kPoints), vs(kPoints);
  for (double& p : parts) p = part(random);
  parts[0] = 0, parts[1] = 1;
  for (const OperationCase& c : cases()) {
    Graph graph;
    const Expr f = c.engine(graph.variable(0));
    const Tape tape(graph, {&f, 1});
    std::vector<double> values(kPoints);
    const OutputArray out{values.data()};
    for (int i = 0; i < kBoxes; ++i) {
      const double lo = place(random);
      const Interval box(lo, lo + std::exp(size(random)));
      Interval bound;
      tape.bound(box, 0, {}, {&bound, 1});
      for (int k = 0; k < kPoints; ++k) us[k] = std::min(box.hi, box.lo + parts[k] * box.width());
      tape.evaluate(us, vs, {}, {&out, 1});
      bool inside = true;
      for (const double value : values) inside &= bound.contains(value) || bound == Interval::everything();
      ASSERT_TRUE(inside) << c.name << " on [" << box.lo << ", " << box.hi << "]: [" << bound.lo << ", "
                          << bound.hi << "]";
    }
  }
}

double valueAt(const std::function<Expr(Expr)>& f, double x) {
  Graph graph;
  const Expr e = f(graph.variable(0));
  double value;
  Tape(graph, {&e, 1}).evaluatePoint(x, 0, {}, {&value, 1});
  return value;
}

TEST(Operation, KnownValues) {
  struct Known {
    std::function<Expr(Expr)> f;
    double x, value;
  };
  const double pi = std::numbers::pi;
  const Known table[] = {
      {[](Expr x) { return atan2(x, -1); }, 1, 3 * pi / 4},
      {[](Expr x) { return atan2(-1, x); }, -1, -3 * pi / 4},
      {[](Expr x) { return sign(x); }, -0.5, -1},
      {[](Expr x) { return sign(x); }, 0, 0},
      {[](Expr x) { return sign(x); }, kInfinity, 1},
      {[](Expr x) { return floor(x); }, -0.5, -1},
      {[](Expr x) { return floor(x); }, 3, 3},
      {[](Expr x) { return mod(x, 3); }, -1, 2},
      {[](Expr x) { return mod(x, -3); }, 1, -2},
      {[](Expr x) { return mod(x, 3); }, 6, 0},
      {[](Expr x) { return less(x, 2); }, 2, 0},
      {[](Expr x) { return lessEqual(x, 2); }, 2, 1},
      {[](Expr x) { return equal(x, 2); }, 2, 1},
      {[](Expr x) { return notEqual(x, 2); }, 2, 0},
      {[](Expr x) { return notEqual(x, 2); }, 2.5, 1},
      {[](Expr x) { return select(x, 3, 4); }, -2, 3},
      {[](Expr x) { return select(x, 3, 4); }, 0, 4},
      {[](Expr x) { return select(less(x, 0), 0, sqrt(x)); }, -4, 0},
      {[](Expr x) { return clamp(x, -1, 2); }, 5, 2},
      {[](Expr x) { return mix(10, 20, x); }, 0.25, 12.5},
      {[](Expr x) { return smoothstep(2, 4, x); }, 3, 0.5},
      {[](Expr x) { return smoothstep(2, 4, x); }, 7, 1},
      {[](Expr x) { return pow(x, x); }, 0, 1},
      {[](Expr x) { return pow(x, 0.25); }, 0, 0},
      {[](Expr x) { return pow(-2, x); }, 3, -8},
      {[](Expr x) { return pow(x, 1'048'577); }, -1, -1},
      {[](Expr x) { return pow(x, -3); }, 0.5, 8},
  };
  for (std::size_t i = 0; i < std::size(table); ++i)
    EXPECT_DOUBLE_EQ(valueAt(table[i].f, table[i].x), table[i].value) << "number " << i;
}

TEST(Operation, OutsideItsDomainIsNotANumber) {
  const std::function<Expr(Expr)> undefined[] = {
      [](Expr x) { return sqrt(x); },          [](Expr x) { return log(x); },
      [](Expr x) { return asin(x); },          [](Expr x) { return acos(x); },
      [](Expr x) { return pow(x, 0.3); },      [](Expr x) { return pow(x, x / 3); },
      [](Expr x) { return min(sqrt(x), 1); },  [](Expr x) { return min(1, sqrt(x)); },
      [](Expr x) { return max(log(x), 1); },   [](Expr x) { return max(1, log(x)); },
      [](Expr x) { return abs(sqrt(x)); },     [](Expr x) { return sign(log(x)); },
      [](Expr x) { return floor(acos(x)); },   [](Expr x) { return clamp(sqrt(x), 0, 1); },
      [](Expr x) { return sqrt(x) * (x + 2); }};
  for (const auto& f : undefined) {
    EXPECT_TRUE(std::isnan(valueAt(f, -2)));
    Graph graph;
    const Expr e = f(graph.variable(0));
    Interval bound;
    Tape(graph, {&e, 1}).bound({-2.5, -1.5}, 0, {}, {&bound, 1});
    EXPECT_EQ(bound, Interval::everything());
  }
  EXPECT_EQ(valueAt([](Expr x) { return 1 / x; }, 0), kInfinity);
  // Constants are folded, holes and all.
  Interval bound;
  Graph graph;
  const Expr e = graph.variable(0) * log(Expr(-1)), q = Expr(1) / 0;
  EXPECT_TRUE(std::isnan(valueAt([](Expr x) { return x * log(Expr(-1)); }, 1)));
  Tape(graph, {&e, 1}).bound(1, 0, {}, {&bound, 1});
  EXPECT_EQ(bound, Interval::everything());
  Tape(graph, {&q, 1}).bound(1, 0, {}, {&bound, 1});
  EXPECT_EQ(bound, Interval::everything());
}

TEST(Operation, DerivativesAtTheEdges) {
  const auto slopeAt = [](const std::function<Expr(Expr, Expr)>& f, std::uint32_t of, double u, double v) {
    Graph graph;
    const Expr d = graph.derivative(f(graph.variable(0), graph.variable(1)), of);
    double value;
    Tape(graph, {&d, 1}).evaluatePoint(u, v, {}, {&value, 1});
    return value;
  };
  const auto power = [](Expr u, Expr v) { return pow(u, v); };
  // d(u^v)/dv at u = 0: 0^v does not change with v; d/du is v u^(v-1).
  EXPECT_EQ(slopeAt(power, 1, 0, 2.5), 0);
  EXPECT_EQ(slopeAt(power, 0, 0, 2.5), 0);
  EXPECT_EQ(slopeAt(power, 0, 0, 1), 1);
  EXPECT_TRUE(std::isnan(slopeAt(power, 0, -1, 2.5)));
  EXPECT_NEAR(slopeAt(power, 1, 3, 2), 9 * std::log(3), 1e-13);
  // Integer powers of negative numbers, the exponent a constant: no logarithm.
  EXPECT_EQ(slopeAt([](Expr u, Expr) { return pow(u, 3.0); }, 0, -2, 0), 12);
  EXPECT_EQ(slopeAt([](Expr u, Expr) { return pow(u, 2.5); }, 0, 0, 0), 0);
  // One of the two pieces at a kink.
  EXPECT_EQ(slopeAt([](Expr u, Expr) { return abs(u); }, 0, 0, 0), 0);
  EXPECT_EQ(std::abs(slopeAt([](Expr u, Expr) { return max(u, -u); }, 0, 0, 0)), 1);
  EXPECT_EQ(slopeAt([](Expr u, Expr) { return floor(u); }, 0, 1, 0), 0);
  // The piece that is not chosen may be undefined.
  EXPECT_EQ(slopeAt([](Expr u, Expr) { return select(less(u, 0), u, sqrt(u)); }, 0, -1, 0), 1);
}

}  // namespace
}  // namespace luxo
