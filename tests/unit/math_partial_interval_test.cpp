// SPDX-License-Identifier: Apache-2.0
// Intervals of what is not defined everywhere: they hold what there is, and say so where there is nothing.
#include "math/partial_interval.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "formula/expression.h"
#include "formula/tape.h"

namespace luxo {
namespace {

using Defined = PartialInterval::Defined;

/// Formulas of u and v with holes and borders of every kind.
std::vector<Expr> formulas(Graph& graph) {
  const Expr u = graph.variable(0), v = graph.variable(1), r = sqrt(u * u + v * v);
  return {sqrt(u),
          log(u + v),
          u / v,
          asin(u),
          acos(u * v),
          pow(u, 1.5),
          pow(u, v),
          pow(u, -2),
          sqrt(sqrt(u) - v),
          log(sin(u)) + sqrt(v),
          sin(r) / r,
          select(less(u, v), sqrt(u), log(v)),
          select(less(sqrt(u), v), u, 1.0 / v),
          min(sqrt(u), v),
          max(log(u), v),
          abs(sqrt(1.0 - u * u)) * tan(v),
          atan2(sqrt(u), log(v)),
          exp(sqrt(u)) - cosh(asin(v)),
          floor(sqrt(u)) + sign(log(v)),
          tanh(acos(u)) - sinh(v) + cos(sqrt(u)) * atan(u),
          (3.0 - (u - 5.0) / v) * (1.0 + v * v),
          2.0 - 0.5 * pow(u - v, -3) + v,
          tan(3.0 * u) / (v - 0.1),
          u + 1.0 / (tan(4.0 * v) - 1.0)};
}

TEST(PartialInterval, HoldsAllValuesThatThereAre) {
  Graph graph;
  const std::vector<Expr> outputs = formulas(graph);
  const Tape tape(graph, outputs);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-2, 2), part(0, 1);
  std::vector<std::array<int, 3>> seen(outputs.size());
  std::vector<int> gaps(outputs.size());
  for (int i = 0; i < 3000; ++i) {
    const double size = std::exp(-8 * part(random)), u = place(random), v = place(random);
    const Interval us(u, u + size), vs(v, v + size);
    std::vector<PartialInterval> bounds(outputs.size());
    tape.boundWhereDefined(us, vs, {}, bounds);
    for (const PartialInterval& b : bounds) ++seen[&b - bounds.data()][static_cast<std::size_t>(b.defined)];
    for (int k = 0; k < 20; ++k) {
      std::vector<double> values(outputs.size());
      tape.evaluatePoint(u + part(random) * size, v + part(random) * size, {}, values);
      for (std::size_t f = 0; f < values.size(); ++f) {
        const PartialInterval& b = bounds[f];
        if (std::isfinite(values[f])) {
          ASSERT_NE(b.defined, Defined::Nowhere) << f;
          ASSERT_TRUE(b.range.contains(values[f])) << f << ": " << values[f];
          ASSERT_TRUE(values[f] <= b.gap.lo || values[f] >= b.gap.hi || b.gap.lo >= b.gap.hi)
              << f << ": " << values[f];
          gaps[f] += b.gap.lo < b.gap.hi;
        } else {
          ASSERT_FALSE(b.defined == Defined::Everywhere && std::isfinite(b.range.magnitude())) << f;
        }
      }
    }
  }
  for (std::size_t f = 0; f < seen.size(); ++f) {
    EXPECT_GT(seen[f][1], 0) << f << " has borders";
    EXPECT_GT(seen[f][2], 0) << f << " has places without";
  }
  for (const std::size_t f : {0, 1, 3, 5, 8, 9}) EXPECT_GT(seen[f][0], 100) << f << " is known to be nowhere";
  for (const std::size_t f : {20, 21, 22, 23}) EXPECT_GT(gaps[f], 100) << f << " has poles";
}

TEST(PartialInterval, IsAsSharpAsWhatThereIs) {
  Graph graph;
  const std::vector<Expr> outputs = formulas(graph);
  const Tape tape(graph, outputs);
  std::vector<PartialInterval> b(outputs.size());
  tape.boundWhereDefined({-1, 0.25}, {-1, 0.25}, {}, b);
  EXPECT_NEAR(b[0].range.lo, 0, 1e-15);
  EXPECT_NEAR(b[0].range.hi, 0.5, 1e-15);
  EXPECT_NEAR(b[1].range.hi, std::log(0.5), 1e-15);
}

/// An exponent that was computed is an interval: below 0 only the integers in it count.
TEST(PartialInterval, PowersOfWhatMayBeBelowZero) {
  const PartialInterval across(Interval(-0.25, 0.5)), below(Interval(-0.5, -0.25));
  const PartialInterval none = pow(across, PartialInterval(Interval(2.5, 2.75)));
  EXPECT_EQ(none.defined, Defined::Somewhere);
  EXPECT_EQ(none.range.lo, 0);
  EXPECT_NEAR(none.range.hi, std::pow(0.5, 2.5), 1e-15);
  const PartialInterval cubes = pow(across, PartialInterval(Interval(2.5, 3.5)));
  EXPECT_EQ(cubes.defined, Defined::Somewhere);
  EXPECT_TRUE(cubes.range.contains(std::pow(-0.25, 3)));
  EXPECT_NEAR(cubes.range.lo, -std::pow(0.25, 2.5), 1e-15);
  EXPECT_NEAR(cubes.range.hi, std::pow(0.5, 2.5), 1e-15);
  EXPECT_EQ(pow(below, PartialInterval(Interval(2.25, 2.75))).defined, Defined::Nowhere);
  EXPECT_TRUE(pow(below, PartialInterval(Interval(1.75, 2.25))).range.contains(0.25));
  EXPECT_TRUE(pow(below, PartialInterval(Interval(-1.25, -0.75))).range.contains(-4));
}

TEST(PartialInterval, BesidePolesNothingIsNearZero) {
  const PartialInterval one(1.0), across(Interval(-0.25, 0.125)), right(Interval(0, 0.125));
  EXPECT_FALSE((one / across).within(3.9));
  EXPECT_EQ((one / across).within(6)->hi, -4);
  EXPECT_EQ((one / across).within(9)->hi, 9) << "on both sides";
  EXPECT_EQ((-one / right).within(100)->hi, -8);
  EXPECT_FALSE((PartialInterval(Interval(2, 3)) - 2.0 * (one / across)).within(4.9)) << "-13 .. 10";
  EXPECT_FALSE(tan(PartialInterval(Interval(1.5, 1.6))).within(14));
  EXPECT_TRUE(tan(PartialInterval(Interval(1.5, 1.6))).within(15));
}

}  // namespace
}  // namespace luxo
