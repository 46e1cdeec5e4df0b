// SPDX-License-Identifier: Apache-2.0
// Where formulas are not smooth, and that their derivatives are those of the pieces.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "formula/tape.h"
#include "formula_test_support.h"

namespace luxo {
namespace {

std::vector<Kink> kinksOf(Graph& graph, const Expr& f) { return graph.kinks({&f, 1}); }

/// The one guard of f is g, up to its sign.
void expectGuard(const std::function<Expr(Expr, Expr)>& f, const std::function<Expr(Expr, Expr)>& g,
                 bool atIntegers = false) {
  Graph graph;
  const Expr u = graph.variable(0), v = graph.variable(1);
  const auto kinks = kinksOf(graph, f(u, v));
  ASSERT_EQ(kinks.size(), 1u);
  const std::uint32_t guard = graph.nodeOf(kinks[0].guard);
  EXPECT_TRUE(guard == graph.nodeOf(g(u, v)) || guard == graph.nodeOf(-g(u, v)));
  EXPECT_EQ(kinks[0].atIntegers, atIntegers);
}

TEST(Kinks, GuardsOfEveryOperation) {
  const auto difference = [](Expr u, Expr v) { return u - v; };
  expectGuard([](Expr u, Expr) { return 1 + abs(sin(u)); }, [](Expr u, Expr) { return sin(u); });
  expectGuard([](Expr u, Expr v) { return sign(u * v); }, [](Expr u, Expr v) { return u * v; });
  expectGuard([](Expr u, Expr v) { return min(u, v); }, difference);
  expectGuard([](Expr u, Expr v) { return exp(max(u, v)); }, difference);
  expectGuard([](Expr u, Expr v) { return less(u, v); }, difference);
  expectGuard([](Expr u, Expr v) { return lessEqual(u, v); }, difference);
  expectGuard([](Expr u, Expr v) { return equal(u, v); }, difference);
  expectGuard([](Expr u, Expr v) { return select(less(u, v), u, v); }, difference);
  expectGuard([](Expr u, Expr v) { return select(sin(u), u, v); }, [](Expr u, Expr) { return sin(u); });
  expectGuard([](Expr u, Expr) { return floor(3 * u); }, [](Expr u, Expr) { return 3 * u; }, true);
  expectGuard([](Expr u, Expr) { return mod(u, 2); }, [](Expr u, Expr) { return u / 2; }, true);
  expectGuard([](Expr u, Expr) { return sqrt(u * u); }, [](Expr u, Expr) { return u; });
  expectGuard([](Expr u, Expr v) { return sqrt(max(u, v)); }, difference);
}

TEST(Kinks, SmoothFormulasHaveNone) {
  Graph graph;
  const Expr u = graph.variable(0), v = graph.variable(1), time = graph.variable(2);
  for (const Expr& f : {Expr(3), u, sin(u) * exp(v), sqrt(u), pow(u, 1.5), abs(u * u), 1 / u, abs(Expr(-2)),
                        // Parameters do not change within a picture.
                        u * abs(time), select(less(time, 2), u, v), floor(time) + u, min(time, 3) * u})
    EXPECT_TRUE(kinksOf(graph, f).empty());
}

TEST(Kinks, EachIsNamedOnce) {
  Graph graph;
  const Expr u = graph.variable(0), v = graph.variable(1);
  // sign and abs of the same; the jumps of floor only where floor is.
  EXPECT_EQ(kinksOf(graph, sign(u) * abs(u)).size(), 1u);
  EXPECT_EQ(kinksOf(graph, abs(floor(u) - 3) + sign(floor(u))).size(), 1u);
  EXPECT_EQ(kinksOf(graph, select(less(u, v), abs(u), abs(u) + 1)).size(), 2u);
  const Expr roots[] = {abs(u), abs(u) * v, abs(v)};
  EXPECT_EQ(graph.kinks(roots).size(), 2u);
  EXPECT_EQ(kinksOf(graph, abs(u) + floor(u)).size(), 2u);
}

TEST(Kinks, TheAngleJumpsOnOneSideOnly) {
  Graph graph;
  const Expr u = graph.variable(0), v = graph.variable(1);
  const auto kinks = kinksOf(graph, atan2(v, u));
  ASSERT_EQ(kinks.size(), 1u);
  const Tape tape(graph, {&kinks[0].guard, 1});
  const auto mayVanish = [&](Interval us, Interval vs) {
    Interval bound;
    tape.bound(us, vs, {}, {&bound, 1});
    return bound.contains(0);
  };
  EXPECT_TRUE(mayVanish({-2, -1}, {-1, 1}));
  EXPECT_FALSE(mayVanish({1, 2}, {-1, 1}));
  EXPECT_FALSE(mayVanish({-2, -1}, {0.5, 1}));
}

/// Whether a guard may be 0, or an integer, somewhere in its range.
bool mayKink(const Kink& kink, const Interval& range) {
  return kink.atIntegers ? std::floor(range.lo) != std::floor(range.hi) || range.lo == std::floor(range.lo)
                         : range.contains(0);
}

TEST(Kinks, BetweenGuardsFormulasAreAsSmoothAsBounded) {
  // The mean value theorem along random segments of random formulas: where no guard passes its value, the
  // formula is continuous and its difference lies in the range of its derivative times the length. A missing
  // guard would let a jump through.
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> coordinate(-3, 3), size(-5, 1);
  int smooth = 0, kinked = 0;
  for (int i = 0; i < 3'000; ++i) {
    Graph graph;
    const Expr f =
        RandomFormula(random, 4 + i % 25, true)(graph.variable(0), graph.variable(1), graph.variable(2));
    const std::vector<Kink> kinks = kinksOf(graph, f);
    std::vector<Expr> outputs{f, graph.derivative(f, 0)};
    for (const Kink& kink : kinks) outputs.push_back(kink.guard);
    const Tape tape(graph, outputs);
    std::vector<double> first(outputs.size()), second(outputs.size());
    std::vector<Interval> bounds(outputs.size());
    for (int k = 0; k < 20; ++k) {
      const double u = coordinate(random), v = coordinate(random), p = coordinate(random);
      const Interval us(u, u + std::exp(size(random)));
      tape.bound(us, v, {&p, 1}, bounds);
      bool hasKink = false;
      for (std::size_t g = 0; g < kinks.size(); ++g) hasKink |= mayKink(kinks[g], bounds[2 + g]);
      hasKink ? ++kinked : ++smooth;
      if (hasKink || !std::isfinite(bounds[1].width())) continue;
      tape.evaluatePoint(us.lo, v, {&p, 1}, first);
      tape.evaluatePoint(us.hi, v, {&p, 1}, second);
      // Rounding: that of the two values, which their own bounds hold.
      std::vector<Interval> atFirst(outputs.size()), atSecond(outputs.size());
      tape.bound(us.lo, v, {&p, 1}, atFirst);
      tape.bound(us.hi, v, {&p, 1}, atSecond);
      const double rounding = atFirst[0].width() + atSecond[0].width() + 1e-300;
      const Interval change = bounds[1] * (Interval(us.hi) - Interval(us.lo));
      const double difference = second[0] - first[0];
      ASSERT_TRUE(change.lo - rounding <= difference && difference <= change.hi + rounding)
          << "formula " << i << ": " << difference << " outside [" << change.lo << ", " << change.hi << "]";
    }
  }
  EXPECT_GT(smooth, 15'000);
  EXPECT_GT(kinked, 1'000);
}

}  // namespace
}  // namespace luxo
