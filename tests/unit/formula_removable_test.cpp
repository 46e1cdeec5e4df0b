// SPDX-License-Identifier: Apache-2.0
// Formulas with removable singularities go on through them.
#include "formula/removable.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "formula/tape.h"

namespace luxo {
namespace {

using Formula = std::function<Expr(Expr, Expr)>;

double valueAt(Graph& graph, Expr f, double u, double v) {
  double value = 0;
  Tape(graph, {&f, 1}).evaluatePoint(u, v, {}, {&value, 1});
  return value;
}

struct Removable {
  Formula formula;
  double u, v, limit;
};

TEST(Removable, TheFormulaHasItsLimitAndIsTheSameElsewhere) {
  const Formula r = [](Expr u, Expr v) { return sqrt(u * u + v * v); };
  const std::vector<Removable> all{
      {[](Expr u, Expr) { return sin(u) / u; }, 0, 0.5, 1},
      {[](Expr u, Expr) { return sin(3 * u) / u; }, 0, 0.5, 3},
      {[](Expr u, Expr v) { return 2 * sin(u) * cos(v) / u; }, 0, 0, 2},
      {[](Expr u, Expr v) { return sin(u) * sin(v) / (u * v); }, 0, 0, 1},
      {[](Expr u, Expr v) { return sin(u) / u * (sin(v) / v); }, 0, 0, 1},
      {[](Expr u, Expr v) { return 1 / u * (exp(v) * sin(u)); }, 0, 1, std::exp(1)},
      {[&](Expr u, Expr v) { return sin(r(u, v)) / r(u, v); }, 0, 0, 1},
      {[&](Expr u, Expr v) { return sin(8 * r(u, v)) / (2 * r(u, v)); }, 0, 0, 4},
      {[&](Expr u, Expr v) { return pow(sin(r(u, v)) / r(u, v), 2); }, 0, 0, 1},
      {[](Expr u, Expr) { return pow(sin(u), 2) / pow(u, 2); }, 0, 0, 1},
      {[](Expr u, Expr) { return sin(abs(u)) / abs(u); }, 0, 0, 1},
      {[](Expr u, Expr) { return tan(2 * u) / u; }, 0, 0, 2},
      {[](Expr u, Expr) { return sinh(u) / u; }, 0, 0, 1},
      {[](Expr u, Expr) { return (1 - cos(u)) / pow(u, 2); }, 0, 0, 0.5},
      {[](Expr u, Expr) { return (cosh(u) - 1) / (u * u); }, 0, 0, 0.5},
      {[](Expr u, Expr) { return (exp(u) - 1) / u; }, 0, 0, 1},
      {[](Expr u, Expr v) { return (1 - exp(-(u * u + v * v))) / (u * u + v * v); }, 0, 0, 1},
      {[](Expr u, Expr v) { return (u * u - v * v) / (u - v); }, 0.3, 0.3, 0.6},
      {[](Expr u, Expr v) { return (pow(u, 3) - pow(v, 3)) / (v - u); }, 2, 2, -12},
      {[](Expr u, Expr v) { return (u * v) / (u * u + u * v); }, 0, 2, 1},
      {[](Expr u, Expr v) { return sin(u * u - v * v) / (u - v); }, 0.5, 0.5, 1},
      {[](Expr u, Expr v) { return (u * sin(v) + u) / u; }, 0, 0, 1},
      {[](Expr u, Expr v) { return (u * v + sin(u)) / u; }, 0, 2, 3},
      {[](Expr u, Expr v) { return exp(sin(u) / u + v); }, 0, 1, std::exp(2)},
      {[&](Expr u, Expr v) { return (pow(r(u, v), 2) - 1) / (r(u, v) - 1); }, 0.6, 0.8, 2},
  };
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-3, 3);
  for (const Removable& one : all) {
    const std::size_t number = &one - all.data();
    Graph graph;
    const Expr f = one.formula(graph.variable(0), graph.variable(1));
    const Expr through = continued(graph, {&f, 1})[0];
    EXPECT_FALSE(std::isfinite(valueAt(graph, f, one.u, one.v))) << number;
    EXPECT_NEAR(valueAt(graph, through, one.u, one.v), one.limit, 1e-14 * std::abs(one.limit)) << number;
    for (int i = 0; i < 200; ++i) {
      const double u = place(random), v = place(random), value = valueAt(graph, f, u, v);
      // The quotient itself loses digits beside its singularity.
      const double lost = 1e-13 + 1e-15 / (u * u);
      EXPECT_NEAR(valueAt(graph, through, u, v), value, lost * (100 + std::abs(value))) << number;
    }
    const Tape tape(graph, {&through, 1});
    PartialInterval bounds;
    tape.boundWhereDefined({one.u - 0.01, one.u + 0.01}, {one.v - 0.01, one.v + 0.01}, {}, {&bounds, 1});
    EXPECT_EQ(bounds.defined, PartialInterval::Defined::Everywhere) << number;
    EXPECT_LT(bounds.range.width(), 1) << number;
  }
}

TEST(Removable, DerivativesGoOnToo) {
  Graph graph;
  const Expr u = graph.variable(0), v = graph.variable(1), r = sqrt(u * u + v * v), f = sin(r) / r;
  const Expr through = continued(graph, {&f, 1})[0], slope = graph.derivative(through, 0);
  EXPECT_EQ(valueAt(graph, slope, 0, 0), 0);
  EXPECT_NEAR(valueAt(graph, graph.derivative(slope, 0), 0, 0), -1 / 3.0, 1e-15);  // 1 - r^2 / 6
  EXPECT_NEAR(valueAt(graph, slope, 2, 0), std::cos(2) / 2 - std::sin(2) / 4, 1e-15);
}

TEST(Removable, WhatIsNotRemovableStays) {
  const std::vector<Formula> all{
      [](Expr u, Expr) { return 1 / u; },
      [](Expr u, Expr v) { return u / (u - v); },
      [](Expr u, Expr) { return cos(u) / u; },
      [](Expr u, Expr v) { return sin(u) / v; },
      [](Expr u, Expr) { return u / abs(u); },
      [](Expr u, Expr) { return abs(u) / u; },
      [](Expr u, Expr v) { return (u * u + v * v) / (u - v); },
      [](Expr u, Expr v) { return u * v / (u * u + v * v); },
      [](Expr u, Expr v) { return sin(u) * exp(v) + cos(u * v) / (2 + v); },
      [](Expr u, Expr) { return (u * u - 0.01) / (u - 0.1); },  // 0.1 * 0.1 is not 0.01 in double
  };
  for (const Formula& formula : all) {
    Graph graph;
    const Expr f = formula(graph.variable(0), graph.variable(1));
    EXPECT_EQ(graph.nodeOf(continued(graph, {&f, 1})[0]), graph.nodeOf(f)) << &formula - all.data();
  }
}

TEST(Removable, PolesAndBordersAreKept) {
  Graph graph;
  const Expr u = graph.variable(0), v = graph.variable(1);
  const Expr outputs[] = {sin(u) / pow(u, 3), sin(sqrt(v)) / sqrt(v), u * log(v) / u};
  const std::vector<Expr> through = continued(graph, outputs);
  EXPECT_EQ(valueAt(graph, through[0], 0, 0), INFINITY);
  EXPECT_NEAR(valueAt(graph, through[0], 0.5, 0), std::sin(0.5) * 8, 1e-14);
  EXPECT_NEAR(valueAt(graph, through[1], 0, 0), 1, 1e-15);
  EXPECT_TRUE(std::isnan(valueAt(graph, through[1], 0, -1))) << "sinh is not meant";
  EXPECT_NEAR(valueAt(graph, through[2], 0, 2), std::log(2), 1e-15);
  EXPECT_TRUE(std::isnan(valueAt(graph, through[2], 0, -1)));
}

TEST(Removable, LargeFormulasCostNoMoreThanTheyAreLong) {
  Graph graph;
  const Expr u = graph.variable(0), v = graph.variable(1);
  Expr sum = 0, nested = u;
  for (int k = 1; k <= 300; ++k) sum = sum + sin(k * u) * cos(v) / (k * u);
  for (int k = 0; k < 200; ++k) nested = (nested * nested + nested) / (nested + v);
  const Expr outputs[] = {sum, nested, sum / nested};
  const std::vector<Expr> through = continued(graph, outputs);
  EXPECT_NEAR(valueAt(graph, through[0], 0, 0), 300, 1e-10);
  EXPECT_LT(graph.nodes().size(), 40'000U);
}

}  // namespace
}  // namespace luxo
