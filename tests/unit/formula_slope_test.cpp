// SPDX-License-Identifier: Apache-2.0
#include "formula/slope.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "formula/factors.h"
#include "formula/pythagoras.h"
#include "formula/tape.h"

namespace luxo {
namespace {

double evaluated(Graph& graph, Expr f, double u, double v) {
  double value = 0;
  Tape(graph, {&f, 1}).evaluatePoint(u, v, {}, {&value, 1});
  return value;
}

TEST(Slope, IsTheQuotientAndAtThePlaceTheDerivative) {
  Graph graph;
  const Expr u = graph.variable(0), v = graph.variable(1);
  const Expr formulas[] = {-u,         u + u * v,      u - v,       u * u * sin(u), u / (2 + v * u),
                           pow(u, 5),  pow(2 + u, -3), sqrt(2 + u), sin(3 * u + v), cos(u * u),
                           exp(u * v), tan(0.5 * u),   sinh(u),     cosh(u - v),    tanh(2 * u + v)};
  const double at = 0.4, other = 0.7;
  for (const Expr& f : formulas) {
    const std::optional<Expr> found = slope(graph, f, 0, at);
    ASSERT_TRUE(found) << &f - formulas;
    for (const double x : {-0.9, 0.1, 1.2})
      EXPECT_NEAR(evaluated(graph, *found, x, other),
                  (evaluated(graph, f, x, other) - evaluated(graph, f, at, other)) / (x - at), 1e-13)
          << &f - formulas;
    EXPECT_NEAR(evaluated(graph, *found, at, other), evaluated(graph, graph.derivative(f, 0), at, other),
                1e-14)
        << &f - formulas;
  }
}

TEST(Slope, OfWhatHasNoRuleThereIsNone) {
  Graph graph;
  const Expr u = graph.variable(0), v = graph.variable(1);
  EXPECT_FALSE(slope(graph, abs(u), 0, 0));
  const std::optional<Expr> still = slope(graph, abs(v), 0, 0);
  ASSERT_TRUE(still && still->isConstant());
  EXPECT_EQ(still->constant(), 0);
}

TEST(Factors, AreThoseOfAllTerms) {
  Graph graph;
  const Expr u = graph.variable(0), v = graph.variable(1);
  const Expr formulas[] = {-2 * pow(u, 3) * sin(v) + u * u * v, u * u / v, 0, u * pow(2 * u, 2)};
  const std::vector<Product> products = factored(graph, formulas);
  const auto common = commonFactors(products);
  EXPECT_EQ(common, (std::map<std::uint32_t, int>{{graph.nodeOf(u), 2}}));
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(evaluated(graph, expressionOf(graph, products[i]), 0.3, 0.7),
                evaluated(graph, formulas[i], 0.3, 0.7), 1e-16);
    EXPECT_NEAR(evaluated(graph, expressionOf(graph, quotient(products[i], common)), 0.3, 0.7),
                evaluated(graph, formulas[i], 0.3, 0.7) / 0.09, 1e-15);
  }
}

TEST(Pythagoras, JoinsSquaresOfTurns) {
  Graph graph;
  const Expr u = graph.variable(0), v = graph.variable(1);
  const Expr ball = pow(sin(v) * cos(u), 2) * 9 + pow(3 * sin(v) * sin(u), 2) + 9 * pow(cos(v), 2);
  const Expr nine = withoutSquaresOfTurns(graph, ball);
  ASSERT_TRUE(nine.isConstant());
  EXPECT_EQ(nine.constant(), 9);
  const Expr turned = v * pow(sin(u), 2) - (-v) * pow(cos(u), 2) + u;
  EXPECT_EQ(graph.nodeOf(withoutSquaresOfTurns(graph, turned)), graph.nodeOf(u + v));
  for (const Expr& other : {pow(sin(u), 2) + 2 * pow(cos(u), 2), pow(sin(u), 2) - pow(cos(u), 2),
                            pow(sin(u), 2) + pow(cos(v), 2)})
    EXPECT_EQ(graph.nodeOf(withoutSquaresOfTurns(graph, other)), graph.nodeOf(other));
}

}  // namespace
}  // namespace luxo
