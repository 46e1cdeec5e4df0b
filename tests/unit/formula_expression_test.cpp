// SPDX-License-Identifier: Apache-2.0
#include "formula/expression.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "formula/tape.h"
#include "formula_test_support.h"

namespace luxo {
namespace {

using Real = long double;
constexpr double kUlp = 0x1p-52;

double valueOf(Graph& graph, Expr f, double u, double v = 0, std::vector<double> parameters = {}) {
  const Tape tape(graph, {&f, 1});
  return tape.evaluate({&u, 1}, {&v, 1}, parameters)[0][0];
}

TEST(Expression, EqualSubexpressionsAreOneNode) {
  Graph graph;
  const Expr u = graph.variable(0), v = graph.variable(1);
  EXPECT_EQ(graph.nodeOf(sin(u + v) * 2), graph.nodeOf(2 * sin(v + u)));
  EXPECT_EQ(graph.nodeOf(u * v), graph.nodeOf(v * u));
  EXPECT_EQ(graph.nodeOf(graph.variable(1)), graph.nodeOf(v));
  EXPECT_EQ(graph.nodeOf(0.25), graph.nodeOf(Expr(0.5) * 0.5));
  EXPECT_NE(graph.nodeOf(u - v), graph.nodeOf(v - u));
  EXPECT_NE(graph.nodeOf(u / v), graph.nodeOf(v / u));
  EXPECT_NE(graph.nodeOf(pow(u, 2)), graph.nodeOf(pow(u, 3)));
  const std::size_t before = graph.nodes().size();
  for (int i = 0; i < 100; ++i) static_cast<void>(sin(u + v) * 2);
  EXPECT_EQ(graph.nodes().size(), before);
}

TEST(Expression, ConstantsFoldAndNeutralElementsVanish) {
  Graph graph;
  const Expr u = graph.variable(0);
  const std::uint32_t node = graph.nodeOf(u);
  for (const Expr& same : {u + 0, 0 + u, u - 0, u * 1, 1 * u, u / 1, pow(u, 1), -(-u)})
    EXPECT_EQ(graph.nodeOf(same), node);
  for (const auto& [f, value] : {std::pair<Expr, double>{u * 0, 0},
                                 {0 * u, 0},
                                 {0 / u, 0},
                                 {pow(u, 0), 1},
                                 {cos(Expr(0)), 1},
                                 {Expr(2) + 3, 5},
                                 {pow(Expr(2), -2), 0.25}}) {
    ASSERT_TRUE(f.isConstant());
    EXPECT_EQ(f.constant(), value);
  }
  EXPECT_EQ(graph.nodeOf(-1 * u), graph.nodeOf(-u));
  EXPECT_EQ(graph.nodeOf(0 - u), graph.nodeOf(-u));
}

TEST(Expression, OperandsComeBeforeTheirNode) {
  std::mt19937_64 random(1);
  Graph graph;
  const RandomFormula formula(random, 60, true);
  const Expr f = formula(graph.variable(0), graph.variable(1), graph.variable(2));
  static_cast<void>(graph.derivative(f, 0));
  const auto& nodes = graph.nodes();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    EXPECT_TRUE(operandCount(nodes[i].op) < 1 || nodes[i].a < i);
    EXPECT_TRUE(operandCount(nodes[i].op) < 2 || nodes[i].b < i);
  }
}

TEST(ExpressionDeath, GraphsDoNotMix) {
  Graph one, other;
  const Expr u = one.variable(0), foreign = other.variable(0);
  EXPECT_DEATH(static_cast<void>(u + foreign), "graph");
}

TEST(Derivative, OfEveryOperationAsInTheTables) {
  struct Case {
    std::string name;
    std::function<Expr(Expr)> f;
    std::function<Real(Real)> slope, curvature;
  };
  const std::vector<Case> cases{
      {"-x", [](Expr x) { return -x; }, [](Real) { return -1; }, [](Real) { return 0; }},
      {"x + 3", [](Expr x) { return x + 3; }, [](Real) { return 1; }, [](Real) { return 0; }},
      {"3 - x", [](Expr x) { return 3 - x; }, [](Real) { return -1; }, [](Real) { return 0; }},
      {"3 x", [](Expr x) { return 3 * x; }, [](Real) { return 3; }, [](Real) { return 0; }},
      {"x x", [](Expr x) { return x * x; }, [](Real x) { return 2 * x; }, [](Real) { return 2; }},
      {"3 / x", [](Expr x) { return 3 / x; }, [](Real x) { return -3 / (x * x); },
       [](Real x) { return 6 / (x * x * x); }},
      {"x / 3", [](Expr x) { return x / 3; }, [](Real) { return 1 / Real(3); }, [](Real) { return 0; }},
      {"x^5", [](Expr x) { return pow(x, 5); }, [](Real x) { return 5 * x * x * x * x; },
       [](Real x) { return 20 * x * x * x; }},
      {"x^2", [](Expr x) { return pow(x, 2); }, [](Real x) { return 2 * x; }, [](Real) { return 2; }},
      {"x^-2", [](Expr x) { return pow(x, -2); }, [](Real x) { return -2 / (x * x * x); },
       [](Real x) { return 6 / (x * x * x * x); }},
      {"sqrt", [](Expr x) { return sqrt(x); }, [](Real x) { return 1 / (2 * std::sqrt(x)); },
       [](Real x) { return -1 / (4 * x * std::sqrt(x)); }},
      {"exp", [](Expr x) { return exp(x); }, [](Real x) { return std::exp(x); },
       [](Real x) { return std::exp(x); }},
      {"log", [](Expr x) { return log(x); }, [](Real x) { return 1 / x; },
       [](Real x) { return -1 / (x * x); }},
      {"sin", [](Expr x) { return sin(x); }, [](Real x) { return std::cos(x); },
       [](Real x) { return -std::sin(x); }},
      {"cos", [](Expr x) { return cos(x); }, [](Real x) { return -std::sin(x); },
       [](Real x) { return -std::cos(x); }},
      {"tan", [](Expr x) { return tan(x); }, [](Real x) { return 1 / (std::cos(x) * std::cos(x)); },
       [](Real x) { return 2 * std::tan(x) / (std::cos(x) * std::cos(x)); }},
      {"sinh", [](Expr x) { return sinh(x); }, [](Real x) { return std::cosh(x); },
       [](Real x) { return std::sinh(x); }},
      {"cosh", [](Expr x) { return cosh(x); }, [](Real x) { return std::sinh(x); },
       [](Real x) { return std::cosh(x); }},
      {"tanh", [](Expr x) { return tanh(x); }, [](Real x) { return 1 / (std::cosh(x) * std::cosh(x)); },
       [](Real x) { return -2 * std::tanh(x) / (std::cosh(x) * std::cosh(x)); }},
  };
  for (const Case& c : cases) {
    Graph graph;
    const Expr f = c.f(graph.variable(0));
    const Expr slope = graph.derivative(f, 0), curvature = graph.derivative(slope, 0);
    EXPECT_TRUE(graph.derivative(f, 1).isConstant() && graph.derivative(f, 1).constant() == 0) << c.name;
    for (double x = 0.125; x < 1.5; x += 0.0625) {
      // A handful of rounded operations on results of size up to cosh(1.5)^2 and 1 / x^4 <= 4096.
      const double s = double(c.slope(x)), k = double(c.curvature(x));
      EXPECT_NEAR(valueOf(graph, slope, x), s, 16 * kUlp * (1 + std::abs(s))) << c.name << " at " << x;
      EXPECT_NEAR(valueOf(graph, curvature, x), k, 16 * kUlp * (1 + std::abs(k))) << c.name << " at " << x;
    }
  }
}

TEST(Derivative, ProductQuotientAndChainRules) {
  Graph graph;
  const Expr u = graph.variable(0), v = graph.variable(1);
  const double x = 0.7, y = -1.3;
  const Expr product = sin(3 * u) * exp(u * v);
  EXPECT_NEAR(valueOf(graph, graph.derivative(product, 0), x, y),
              3 * std::cos(3 * x) * std::exp(x * y) + y * std::sin(3 * x) * std::exp(x * y), 16 * kUlp);
  EXPECT_NEAR(valueOf(graph, graph.derivative(product, 1), x, y), x * std::sin(3 * x) * std::exp(x * y),
              16 * kUlp);
  const Expr quotient = (u + v) / (u * u + 1);
  EXPECT_NEAR(valueOf(graph, graph.derivative(quotient, 0), x, y),
              1 / (x * x + 1) - 2 * x * (x + y) / ((x * x + 1) * (x * x + 1)), 16 * kUlp);
  const Expr wave = cos(u * u * v);  // mixed derivative -2u sin(u^2 v) - 2 u^3 v cos(u^2 v)
  const Expr mixed = graph.derivative(graph.derivative(wave, 0), 1);
  EXPECT_NEAR(valueOf(graph, mixed, x, y),
              -2 * x * std::sin(x * x * y) - 2 * x * x * x * y * std::cos(x * x * y), 32 * kUlp);
}

/// f, fu, fv, fuu, fuv, fvv of a formula, compiled.
Tape compileJet(Graph& graph, const RandomFormula& formula) {
  const Expr f = formula(graph.variable(0), graph.variable(1), graph.variable(2));
  const Expr fu = graph.derivative(f, 0), fv = graph.derivative(f, 1);
  const Expr outputs[] = {
      f, fu, fv, graph.derivative(fu, 0), graph.derivative(fu, 1), graph.derivative(fv, 1)};
  return {graph, outputs};
}

/// The same six numbers by nested dual numbers in long double.
std::array<Real, 6> jetByDuals(const RandomFormula& formula, double u, double v, double parameter) {
  using Second = Dual<Dual<Real>>;
  const auto seed = [](double x, double outer, double inner) {
    return Second{{Real(x), Real(inner)}, {Real(outer), Real(0)}};
  };
  const Second p = parameter;
  const Second uu = formula(seed(u, 1, 1), Second(v), p);
  const Second uv = formula(seed(u, 1, 0), seed(v, 0, 1), p);
  const Second vv = formula(Second(u), seed(v, 1, 1), p);
  return {uu.value.value, uu.slope.value, vv.slope.value, uu.slope.slope, uv.slope.slope, vv.slope.slope};
}

TEST(Derivative, EqualsDualNumbersOnRandomFormulas) {
  // The tolerance is no guess: interval evaluation at the point holds the exact value of the formula that was
  // differentiated, whatever its condition, but for the constants that were folded into one: a few roundings,
  // each no worse than that of the operation that uses the constant, which the width holds. The duals' own
  // rounding is 2^-11 of that.
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> coordinate(-2, 2);
  int sharp = 0, all = 0;
  for (int i = 0; i < 400; ++i) {
    Graph graph;
    const RandomFormula formula(random, 5 + i % 30, true);
    const Tape tape = compileJet(graph, formula);
    for (int k = 0; k < 20; ++k) {
      const double u = coordinate(random), v = coordinate(random), p = coordinate(random);
      const auto expected = jetByDuals(formula, u, v, p);
      const auto computed = tape.evaluate({&u, 1}, {&v, 1}, {&p, 1});
      std::array<Interval, 6> bounds;
      tape.bound(u, v, {&p, 1}, bounds);
      for (int d = 0; d < 6; ++d) {
        if (!std::isfinite(expected[d])) continue;
        const Real margin = 2 * bounds[d].width() + std::abs(expected[d]) * 0x1p-50L;
        ASSERT_TRUE(bounds[d].lo - margin <= expected[d] && expected[d] <= bounds[d].hi + margin)
            << "formula " << i << ", derivative " << d << ": " << expected[d] << " by duals, ["
            << bounds[d].lo << ", " << bounds[d].hi << "] by the engine";
        ASSERT_TRUE(bounds[d].contains(computed[d][0]));
        ++all;
        if (bounds[d].width() <= 1e-9 * (1 + std::abs(expected[d]))) ++sharp;
      }
    }
  }
  EXPECT_GT(all, 40'000);
  EXPECT_GT(sharp, all * 9 / 10) << "the comparison says little when intervals are wide";
}

TEST(Derivative, EqualsCentralDifferences) {
  // Fourth order, step h: error h^4 f5 / 30 + 2^-63 |f| / h; both below 1e-10 (1 + |f'|) for h = 1e-4 unless
  // the formula is wild there, which the disagreement between h and 2h tells.
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  int compared = 0, all = 0;
  for (int i = 0; i < 400; ++i) {
    Graph graph;
    const RandomFormula formula(random, 5 + i % 20, true);
    const Tape tape = compileJet(graph, formula);
    for (int k = 0; k < 10; ++k) {
      const double u = coordinate(random), v = coordinate(random), p = coordinate(random);
      const auto difference = [&](Real h, bool alongU) {
        const auto f = [&](Real x) {
          return formula(Real(u) + (alongU ? x : 0), Real(v) + (alongU ? 0 : x), Real(p));
        };
        return (8 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12 * h);
      };
      const auto computed = tape.evaluate({&u, 1}, {&v, 1}, {&p, 1});
      for (const bool alongU : {true, false}) {
        const Real fine = difference(1e-4L, alongU), coarse = difference(2e-4L, alongU);
        ++all;
        const Real tolerance = 1e-9L * (1 + std::abs(fine));
        if (!(std::abs(fine - coarse) < tolerance)) continue;
        ++compared;
        ASSERT_NEAR(computed[alongU ? 1 : 2][0], double(fine), double(tolerance)) << "formula " << i;
      }
    }
  }
  EXPECT_GT(compared, all * 9 / 10);
}

TEST(Derivative, OfSharedSubexpressionsGrowsLinearly) {
  // f <- f f + v uses every step twice: a tree would have 2^200 leaves.
  Graph graph;
  Expr f = graph.variable(0);
  const Expr v = graph.variable(1);
  constexpr std::size_t kSteps = 200;
  for (std::size_t i = 0; i < kSteps; ++i) f = f * f + v;
  EXPECT_LE(graph.nodes().size(), 2 * kSteps + 2);
  const Expr first = graph.derivative(f, 0);
  EXPECT_LE(graph.nodes().size(), 8 * kSteps);
  static_cast<void>(graph.derivative(first, 1));
  EXPECT_LE(graph.nodes().size(), 32 * kSteps);
}

TEST(Derivative, NoFormulaIsTooDeep) {
  // f <- f / 2 + v, 100,000 times: f = 2 v + (u - 2 v) / 2^100000, so f = 2v, fu = 0 and fv = 2 in double.
  Graph graph;
  Expr f = graph.variable(0);
  const Expr v = graph.variable(1);
  for (int i = 0; i < 100'000; ++i) f = f * 0.5 + v;
  const Expr fu = graph.derivative(f, 0), fv = graph.derivative(f, 1);
  EXPECT_EQ(valueOf(graph, f, 5, 0.75), 1.5);
  EXPECT_EQ(valueOf(graph, fu, 5, 0.75), 0);
  EXPECT_EQ(valueOf(graph, fv, 5, 0.75), 2);
  Interval bound;
  Tape(graph, {&f, 1}).bound({4, 6}, {0.5, 1}, {}, {&bound, 1});
  EXPECT_NEAR(bound.lo, 1, 1e-14);
  EXPECT_NEAR(bound.hi, 2, 1e-14);
}

}  // namespace
}  // namespace luxo
