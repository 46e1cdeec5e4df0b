// SPDX-License-Identifier: Apache-2.0
// What becomes one node, what must not, how large derivatives grow, and how large anything may grow.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "base/error.h"
#include "formula/tape.h"

namespace luxo {
namespace {

using Formula = std::function<Expr(Expr, Expr)>;

constexpr double kLargest = std::numeric_limits<double>::max();

TEST(Simplify, EqualFormsAreOneNode) {
  const std::pair<Formula, Formula> pairs[] = {
      {[](Expr x, Expr) { return 2 * (3 * x); }, [](Expr x, Expr) { return 6 * x; }},
      {[](Expr x, Expr) { return 1 + (x + 2); }, [](Expr x, Expr) { return x + 3; }},
      {[](Expr x, Expr) { return (x - 1) + 1; }, [](Expr x, Expr) { return x; }},
      {[](Expr x, Expr) { return 5 - (2 - x); }, [](Expr x, Expr) { return 3 + x; }},
      {[](Expr x, Expr) { return 5 - (2 + x); }, [](Expr x, Expr) { return 3 - x; }},
      {[](Expr x, Expr y) { return (1 + x) - (1 - y); }, [](Expr x, Expr y) { return x + y; }},
      {[](Expr x, Expr) { return x + x; }, [](Expr x, Expr) { return 2 * x; }},
      {[](Expr x, Expr) { return 3 * x - x; }, [](Expr x, Expr) { return 2 * x; }},
      {[](Expr x, Expr y) { return x + -y; }, [](Expr x, Expr y) { return x - y; }},
      {[](Expr x, Expr y) { return x - -y; }, [](Expr x, Expr y) { return y + x; }},
      {[](Expr x, Expr y) { return -x + y; }, [](Expr x, Expr y) { return y - x; }},
      {[](Expr x, Expr y) { return -(x - y); }, [](Expr x, Expr y) { return y - x; }},
      {[](Expr x, Expr y) { return -x * -y; }, [](Expr x, Expr y) { return y * x; }},
      {[](Expr x, Expr y) { return (2 * x) * (3 * y); }, [](Expr x, Expr y) { return 6 * (x * y); }},
      {[](Expr x, Expr) { return x * x; }, [](Expr x, Expr) { return pow(x, 2); }},
      {[](Expr x, Expr) { return x * x * x * x; }, [](Expr x, Expr) { return pow(x, 4); }},
      {[](Expr x, Expr) { return pow(pow(x, 2), 3); }, [](Expr x, Expr) { return pow(x, 6); }},
      {[](Expr x, Expr) { return pow(-x, 2); }, [](Expr x, Expr) { return pow(x, 2); }},
      {[](Expr x, Expr) { return pow(-x, 3); }, [](Expr x, Expr) { return -pow(x, 3); }},
      {[](Expr x, Expr) { return pow(x, 2.0); }, [](Expr x, Expr) { return x * x; }},
      {[](Expr x, Expr) { return pow(x, 0.5); }, [](Expr x, Expr) { return sqrt(x); }},
      {[](Expr x, Expr) { return pow(x, -1); }, [](Expr x, Expr) { return 1 / x; }},
      {[](Expr x, Expr) { return x / 4; }, [](Expr x, Expr) { return 0.25 * x; }},
      {[](Expr x, Expr) { return x / 3 * 6; }, [](Expr x, Expr) { return 2 * x; }},
      {[](Expr x, Expr) { return 6 / (2 * x); }, [](Expr x, Expr) { return 3 / x; }},
      {[](Expr x, Expr y) { return (6 * x) / (2 * y); }, [](Expr x, Expr y) { return 3 * (x / y); }},
      {[](Expr x, Expr y) { return x / -y; }, [](Expr x, Expr y) { return -(x / y); }},
      {[](Expr x, Expr) { return sin(-2 * x); }, [](Expr x, Expr) { return -sin(2 * x); }},
      {[](Expr x, Expr) { return cos(-x); }, [](Expr x, Expr) { return cos(x); }},
      {[](Expr x, Expr) { return atan(-x); }, [](Expr x, Expr) { return -atan(x); }},
      {[](Expr x, Expr) { return abs(-3 * x); }, [](Expr x, Expr) { return abs(3 * x); }},
      {[](Expr x, Expr) { return abs(abs(x)); }, [](Expr x, Expr) { return abs(x); }},
      {[](Expr x, Expr) { return abs(x * x); }, [](Expr x, Expr) { return x * x; }},
      {[](Expr x, Expr) { return sqrt(x * x); }, [](Expr x, Expr) { return abs(x); }},
      {[](Expr x, Expr) { return pow(abs(x), 2); }, [](Expr x, Expr) { return x * x; }},
      {[](Expr x, Expr) { return log(exp(x)); }, [](Expr x, Expr) { return x; }},
      {[](Expr x, Expr) { return floor(floor(x)); }, [](Expr x, Expr) { return floor(x); }},
      {[](Expr x, Expr) { return min(x, x); }, [](Expr x, Expr) { return x; }},
      {[](Expr x, Expr y) { return max(x, y); }, [](Expr x, Expr y) { return max(y, x); }},
      {[](Expr x, Expr y) { return select(1, x, y); }, [](Expr x, Expr) { return x; }},
      {[](Expr x, Expr y) { return select(0, x, y); }, [](Expr, Expr y) { return y; }},
      {[](Expr x, Expr y) { return select(y, x, x); }, [](Expr x, Expr) { return x; }},
      {[](Expr x, Expr y) { return select(notEqual(x, y), x, 1); },
       [](Expr x, Expr y) { return select(equal(x, y), 1, x); }},
      {[](Expr x, Expr) { return x - x; }, [](Expr, Expr) { return 0; }},
      {[](Expr x, Expr) { return exp(x) / exp(x); }, [](Expr, Expr) { return 1; }},
      {[](Expr x, Expr) { return less(x, x); }, [](Expr, Expr) { return 0; }},
      {[](Expr x, Expr) { return lessEqual(x, x); }, [](Expr, Expr) { return 1; }},
      {[](Expr x, Expr) { return pow(1, x); }, [](Expr, Expr) { return 1; }},
      {[](Expr, Expr) { return pow(Expr(2), 0.5); }, [](Expr, Expr) { return std::sqrt(2.0); }},
      {[](Expr, Expr) { return atan2(1, Expr(0)); }, [](Expr, Expr) { return std::atan2(1.0, 0.0); }},
  };
  for (std::size_t i = 0; i < std::size(pairs); ++i) {
    Graph graph;
    const Expr x = graph.variable(0), y = graph.variable(1);
    EXPECT_EQ(graph.nodeOf(pairs[i].first(x, y)), graph.nodeOf(pairs[i].second(x, y))) << "pair " << i;
  }
}

TEST(Simplify, HolesAndOverflowsStay) {
  const std::pair<Formula, Formula> different[] = {
      {[](Expr x, Expr) { return x / x; }, [](Expr, Expr) { return 1; }},
      {[](Expr x, Expr) { return x * (1 / x); }, [](Expr, Expr) { return 1; }},
      {[](Expr x, Expr) { return x * x / x; }, [](Expr x, Expr) { return x; }},
      {[](Expr x, Expr) { return pow(sqrt(x), 2); }, [](Expr x, Expr) { return x; }},
      {[](Expr x, Expr) { return exp(log(x)); }, [](Expr x, Expr) { return x; }},
      {[](Expr x, Expr) { return pow(x, 3) * pow(x, -2); }, [](Expr x, Expr) { return x; }},
      {[](Expr x, Expr) { return sqrt(pow(x, -2)); }, [](Expr x, Expr) { return abs(1 / x); }},
      {[](Expr x, Expr) { return 1e200 * (1e200 * x); }, [](Expr x, Expr) { return HUGE_VAL * x; }},
      {[](Expr x, Expr) { return 1e-200 * (1e-200 * x); }, [](Expr, Expr) { return 0; }},
      {[](Expr x, Expr) { return kLargest + (x + kLargest); }, [](Expr x, Expr) { return HUGE_VAL + x; }},
  };
  for (std::size_t i = 0; i < std::size(different); ++i) {
    Graph graph;
    const Expr x = graph.variable(0), y = graph.variable(1);
    EXPECT_NE(graph.nodeOf(different[i].first(x, y)), graph.nodeOf(different[i].second(x, y)))
        << "pair " << i;
  }
}

TEST(Simplify, NotANumberIsOneConstant) {
  Graph graph;
  const double nan = std::nan("");
  EXPECT_EQ(graph.nodeOf(nan), graph.nodeOf(nan));
  EXPECT_EQ(graph.nodeOf(Expr(0) * -1), graph.nodeOf(0));
}

TEST(Simplify, DerivativesShareWithTheirFormula) {
  // The torus: S, Su and Sv of (R + r cos v)(cos u, sin u), r sin v take 15 operations on their sines and
  // cosines; without sharing, three times that.
  Graph graph;
  const Expr u = graph.variable(0), v = graph.variable(1);
  const Expr rho = 2 + 0.5 * cos(v);
  std::vector<Expr> outputs{rho * cos(u), 0.5 * sin(v), -(rho * sin(u))};
  for (std::uint32_t of = 0; of < 2; ++of)
    for (int k = 0; k < 3; ++k) outputs.push_back(graph.derivative(outputs[k], of));
  std::vector<std::uint32_t> roots;
  for (const Expr& output : outputs) roots.push_back(graph.nodeOf(output));
  int operations = 0;
  for (const std::uint32_t n : reachable(graph, roots)) operations += operandCount(graph.nodes()[n].op) > 0;
  EXPECT_LE(operations, 4 + 15);
}

TEST(Simplify, DerivativesOfProductsStaySmall) {
  // d/du of u^20 written as a product, twelve times: 20!/8! u^8, two operations.
  Graph graph;
  const Expr u = graph.variable(0);
  Expr f = 1;
  for (int i = 0; i < 20; ++i) f = f * u;
  for (int i = 0; i < 12; ++i) f = graph.derivative(f, 0);
  EXPECT_EQ(graph.nodeOf(f), graph.nodeOf(std::tgamma(21) / std::tgamma(9) * pow(u, 8)));
  for (int i = 0; i < 9; ++i) f = graph.derivative(f, 0);
  EXPECT_TRUE(f.isConstant() && f.constant() == 0);
}

TEST(Limits, AMillionOperationsDeep) {
  // f <- sin f, a million times, then everything one does with a formula.
  Graph graph;
  Expr f = graph.variable(0);
  for (int i = 0; i < 1'000'000; ++i) f = sin(f);
  const Expr slope = graph.derivative(f, 0);
  const std::vector<Kink> kinks = graph.kinks({&f, 1});
  EXPECT_TRUE(kinks.empty());
  const Expr outputs[] = {f, slope};
  const Tape tape(graph, outputs);
  double values[2];
  tape.evaluatePoint(1, 0, {}, values);
  // sin^n(x) tends to sqrt(3 / n), with a relative error of order log(n) / n.
  EXPECT_NEAR(values[0], std::sqrt(3e-6), 1e-4 * std::sqrt(3e-6));
  EXPECT_GT(values[1], 0);
  const double u[] = {1, 2}, v[] = {0, 0};
  EXPECT_EQ(tape.evaluate(u, v, {})[0][0], values[0]);
  Interval bounds[2];
  tape.bound(1, 0, {}, bounds);
  EXPECT_TRUE(bounds[0].contains(values[0]));
}

TEST(Limits, TooManyOperationsAreAnError) {
  Graph graph;
  const Expr u = graph.variable(0), v = graph.variable(1);
  Expr f = u;
  for (int i = 0; i < 400'000; ++i) f = sin(f * v + i);
  const auto differentiateTwice = [&] {
    const Expr first = graph.derivative(f, 0);
    static_cast<void>(graph.derivative(first, 0));
  };
  try {
    differentiateTwice();
    FAIL() << "400,000 sines have second derivatives of " << graph.nodes().size() << " operations";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::Scene);
    EXPECT_NE(std::string(error.what()).find("4194304"), std::string::npos) << error.what();
    EXPECT_FALSE(error.hint().empty());
  }
  EXPECT_EQ(graph.nodes().size(), Graph::kMaxNodes);
  // What exists goes on working.
  double value;
  Tape(graph, {&f, 1}).evaluatePoint(0.5, 0.5, {}, {&value, 1});
  EXPECT_TRUE(std::isfinite(value));
  EXPECT_THROW(static_cast<void>(u + 0.123), Error);
}

}  // namespace
}  // namespace luxo
