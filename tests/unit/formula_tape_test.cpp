// SPDX-License-Identifier: Apache-2.0
#include "formula/tape.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <thread>
#include <vector>

#include "formula_test_support.h"

namespace luxo {
namespace {

std::vector<double> randomNumbers(std::mt19937_64& random, std::size_t count, double size = 2) {
  std::uniform_real_distribution<double> coordinate(-size, size);
  std::vector<double> values(count);
  for (double& value : values) value = coordinate(random);
  return values;
}

/// Every point of the grid, evaluated one by one and in one batch, must have the grid's bits.
void expectGridEqualsPoints(const Tape& tape, const std::vector<double>& u, const std::vector<double>& v,
                            const std::vector<double>& parameters) {
  const auto grid = tape.evaluateGrid(u, v, parameters);
  std::vector<double> us, vs;
  for (const double y : v)
    for (const double x : u) {
      us.push_back(x);
      vs.push_back(y);
    }
  const auto batch = tape.evaluate(us, vs, parameters);
  ASSERT_EQ(grid.size(), tape.outputCount());
  ASSERT_EQ(batch.size(), tape.outputCount());
  for (std::size_t k = 0; k < grid.size(); ++k) {
    ASSERT_EQ(grid[k].size(), us.size());
    for (std::size_t i = 0; i < us.size(); ++i) {
      ASSERT_EQ(std::bit_cast<std::uint64_t>(grid[k][i]), std::bit_cast<std::uint64_t>(batch[k][i]))
          << "output " << k << " at column " << i % u.size() << ", row " << i / u.size();
      if (i % 37 != 0) continue;
      const auto alone = tape.evaluate({&us[i], 1}, {&vs[i], 1}, parameters);
      ASSERT_EQ(std::bit_cast<std::uint64_t>(grid[k][i]), std::bit_cast<std::uint64_t>(alone[k][0]));
      std::vector<double> point(tape.outputCount());
      tape.evaluatePoint(us[i], vs[i], parameters, point);
      ASSERT_EQ(std::bit_cast<std::uint64_t>(grid[k][i]), std::bit_cast<std::uint64_t>(point[k]));
    }
  }
}

TEST(Tape, GridsEqualPointsBitForBit) {
  std::mt19937_64 random(1);
  for (const std::size_t columns : {1, 2, 20, 255, 256, 257, 600})
    for (const std::size_t rows : {1, 2, 5}) {
      Graph graph;
      const Expr u = graph.variable(0), v = graph.variable(1), p = graph.variable(2), q = graph.variable(3);
      std::vector<Expr> outputs{1.5,
                                p,
                                q * q,
                                u,
                                v,
                                sin(u),
                                cos(v),
                                u * v,
                                u + sin(v),
                                u - 3,
                                3 - v,
                                p / (2 + u * u),
                                v / p,
                                exp(u) * q,
                                sin(u) * cos(v) + p * u,
                                -(u * v),
                                cos(u * v) * sin(u * v),
                                cos(p) + sin(p) + sqrt(p),
                                min(u, v) + max(u * v, p),
                                select(less(u, v), u, 1),
                                select(p, v, u * v),
                                abs(u) + floor(3 * v) + sign(u * v),
                                pow(abs(u), 1.5) + pow(abs(v) + 1, u),
                                atan2(u, v) + atan2(p, u),
                                pow(u, -4) + pow(u * v, 7),
                                pow(u * v, 3),
                                graph.derivative(tan(u * p + v), 0)};
      for (int i = 0; i < 4; ++i) outputs.push_back(RandomFormula(random, 30, true)(u, v, p));
      expectGridEqualsPoints(Tape(graph, outputs), randomNumbers(random, columns),
                             randomNumbers(random, rows), {0.75, -1.25});
    }
}

TEST(Tape, WildFormulasToo) {
  // Outside their domains: NaN and infinity have bits as well.
  std::mt19937_64 random(2);
  for (int i = 0; i < 200; ++i) {
    Graph graph;
    const Expr f = RandomFormula(random, 25, false)(graph.variable(0), graph.variable(1), graph.variable(2));
    const auto u = randomNumbers(random, 9), v = randomNumbers(random, 4);
    const Tape tape(graph, {&f, 1});
    const double p = 0.3;
    const auto grid = tape.evaluateGrid(u, v, {&p, 1});
    for (std::size_t j = 0; j < v.size(); ++j)
      for (std::size_t c = 0; c < u.size(); ++c) {
        const double a = grid[0][j * u.size() + c];
        double b;
        tape.evaluatePoint(u[c], v[j], {&p, 1}, {&b, 1});
        ASSERT_TRUE(a == b || (std::isnan(a) && std::isnan(b))) << a << " versus " << b;
      }
  }
}

TEST(Tape, KnownValues) {
  Graph graph;
  const Expr u = graph.variable(0), v = graph.variable(1), p = graph.variable(2);
  const Expr outputs[] = {u + 2 * v, u * v - p, pow(u, -2), Expr(7)};
  const Tape tape(graph, outputs);
  const double us[] = {1, 2, 4}, vs[] = {10, 20, 30}, ps[] = {0.5};
  const auto r = tape.evaluate(us, vs, ps);
  EXPECT_EQ(r[0], (std::vector<double>{21, 42, 64}));
  EXPECT_EQ(r[1], (std::vector<double>{9.5, 39.5, 119.5}));
  EXPECT_EQ(r[2], (std::vector<double>{1, 0.25, 0.0625}));
  EXPECT_EQ(r[3], (std::vector<double>{7, 7, 7}));
  const auto grid = tape.evaluateGrid(us, {vs, 2}, ps);
  EXPECT_EQ(grid[0], (std::vector<double>{21, 22, 24, 41, 42, 44}));
}

TEST(Tape, EqualOnesDoTheSame) {
  const auto tape = [](double factor, bool crowded) {
    Graph graph;
    const Expr u = graph.variable(0);
    const Expr v = graph.variable(1);
    const Expr angle = u * v;
    if (crowded) static_cast<void>(sin(v * 3.0) + cos(u));
    const Expr sine = factor * sin(angle);
    const Expr first = sine + cos(angle);
    return Tape(graph, std::vector<Expr>{first, u + factor});
  };
  EXPECT_EQ(tape(2, false), tape(2, true));
  EXPECT_EQ(tape(2, false).hash(), tape(2, true).hash());
  EXPECT_FALSE(tape(2, false) == tape(2.5, false));
  EXPECT_FALSE(tape(2, false) == Tape());
  EXPECT_EQ(Tape(), Tape());

  // What differs in one thing alone, down to the sign of 0.
  const auto one = [](const auto& formula) {
    Graph graph;
    const Expr u = graph.variable(0);
    const Expr v = graph.variable(1);
    return Tape(graph, std::vector<Expr>{formula(u, v)});
  };
  const std::vector<Tape> all{one([](Expr u, Expr v) { return u * v; }),
                              one([](Expr u, Expr v) { return u + v; }),
                              one([](Expr u, Expr) { return sin(u); }),
                              one([](Expr u, Expr) { return tan(u); }),
                              one([](Expr, Expr v) { return sin(v); }),
                              one([](Expr u, Expr) { return pow(u, 3); }),
                              one([](Expr u, Expr) { return pow(u, 5); }),
                              one([](Expr u, Expr v) { return max(u, 0.0 * v); }),
                              one([](Expr u, Expr) { return atan2(u, Expr(0.0)); }),
                              one([](Expr u, Expr) { return atan2(u, Expr(-0.0)); })};
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t k = 0; k < all.size(); ++k) {
      EXPECT_EQ(all[i] == all[k], i == k) << i << ", " << k;
      EXPECT_EQ(all[i].hash() == all[k].hash(), i == k) << i << ", " << k;
    }
}

TEST(Tape, WritesWhereItIsTold) {
  // Points of space, component by component, with a gap that nobody touches.
  Graph graph;
  const Expr u = graph.variable(0), v = graph.variable(1);
  const Expr outputs[] = {u * v, v, Expr(7)};
  const Tape tape(graph, outputs);
  std::vector<double> us(300), vs{10, 20};
  for (std::size_t i = 0; i < us.size(); ++i) us[i] = static_cast<double>(i);
  std::vector<double> points(4 * us.size() * vs.size(), -1);
  const OutputArray to[] = {{&points[0], 4}, {&points[1], 4}, {&points[2], 4}};
  tape.evaluateGrid(us, vs, {}, to);
  for (std::size_t j = 0; j < vs.size(); ++j)
    for (std::size_t i = 0; i < us.size(); ++i) {
      const double* p = &points[4 * (j * us.size() + i)];
      ASSERT_TRUE(p[0] == us[i] * vs[j] && p[1] == vs[j] && p[2] == 7 && p[3] == -1);
    }
}

TEST(Tape, ManyValuesAliveAtOnce) {
  // The registers run out of cache, not out of memory: all 2,000 sines live until the last one is known.
  Graph graph;
  const Expr u = graph.variable(0), v = graph.variable(1);
  std::vector<Expr> waves;
  for (int i = 1; i <= 2'000; ++i) waves.push_back(sin(i * u * v));
  Expr sum = 0;
  for (std::size_t i = 0; i < waves.size(); ++i) sum = sum + waves[i] * waves[waves.size() - 1 - i];
  const Tape tape(graph, {&sum, 1});
  const std::vector<double> us{0.1, 0.2, 0.3}, vs{0.7, 0.9};
  const auto grid = tape.evaluateGrid(us, vs, {});
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 3; ++i) {
      double expected = 0;
      for (int k = 1; k <= 2'000; ++k)
        expected += std::sin(k * us[i] * vs[j]) * std::sin((2'001 - k) * us[i] * vs[j]);
      EXPECT_NEAR(grid[0][j * 3 + i], expected, 1e-9);  // 2,000 terms, angles of 540 rounded
    }
}

TEST(Tape, SameInEveryThread) {
  Graph graph;
  std::mt19937_64 random(9);
  const Expr f = RandomFormula(random, 40, true)(graph.variable(0), graph.variable(1), graph.variable(2));
  const Expr outputs[] = {f, graph.derivative(f, 0), graph.derivative(f, 1)};
  const Tape tape(graph, outputs);
  const auto u = randomNumbers(random, 700), v = randomNumbers(random, 30);
  const double p = 0.5;
  const auto expected = tape.evaluateGrid(u, v, {&p, 1});
  std::vector<int> equal(4);
  std::vector<std::thread> threads;
  for (int& same : equal)
    threads.emplace_back([&] {
      same = 1;
      for (int i = 0; i < 10; ++i) same &= tape.evaluateGrid(u, v, {&p, 1}) == expected;
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(equal, (std::vector<int>{1, 1, 1, 1}));
}

TEST(Tape, ConstantsOnlyAndNothingAtAll) {
  Graph graph;
  const Expr outputs[] = {2, 3.5};
  const Tape tape(graph, outputs);
  const double us[] = {0, 1, 2};
  EXPECT_EQ(tape.evaluateGrid(us, {us, 2}, {})[1], std::vector<double>(6, 3.5));
  EXPECT_EQ(tape.evaluate({}, {}, {})[0], std::vector<double>{});
  EXPECT_EQ(tape.evaluateGrid({}, us, {})[0], std::vector<double>{});
  EXPECT_EQ(Tape().outputCount(), 0u);
}

TEST(Tape, OutlivesItsGraph) {
  Tape tape;
  {
    Graph graph;
    const Expr f = sin(graph.variable(0)) + 0.5;
    tape = Tape(graph, {&f, 1});
  }
  const double x = 0.25;
  EXPECT_EQ(tape.evaluate({&x, 1}, {&x, 1}, {})[0][0], std::sin(0.25) + 0.5);
}

TEST(Tape, BoundsHoldEveryValue) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> coordinate(-3, 3), size(-12, 1), part(0, 1);
  int finite = 0, undefined = 0;
  for (int i = 0; i < 3'000; ++i) {
    Graph graph;
    const Expr f = RandomFormula(random, 3 + i % 25, i % 2 == 0)(graph.variable(0), graph.variable(1),
                                                                 graph.variable(2));
    const Expr outputs[] = {f, graph.derivative(f, 0)};
    const Tape tape(graph, outputs);
    const double u = coordinate(random), v = coordinate(random), p = coordinate(random);
    const Interval us(u, u + std::exp(size(random))), vs(v, v + std::exp(size(random)));
    std::array<Interval, 2> bounds;
    tape.bound(us, vs, {&p, 1}, bounds);
    for (int k = 0; k < 100; ++k) {
      const double x = k == 0 ? us.lo : k == 1 ? us.hi : std::min(us.hi, us.lo + part(random) * us.width());
      const double y = k == 1 ? vs.lo : k == 2 ? vs.hi : std::min(vs.hi, vs.lo + part(random) * vs.width());
      double values[2];
      tape.evaluatePoint(x, y, {&p, 1}, values);
      for (int output = 0; output < 2; ++output) {
        // What is undefined anywhere has no bound: a bound proves that there is no hole.
        const Interval& bound = bounds[output];
        ASSERT_TRUE(bound.contains(values[output]) || bound == Interval::everything())
            << "formula " << i << ": " << values[output] << " outside [" << bound.lo << ", " << bound.hi
            << "]";
        finite += std::isfinite(bound.width());
        undefined += !std::isfinite(values[output]);
      }
    }
  }
  EXPECT_GT(undefined, 1'000);
  EXPECT_GT(finite, 300'000) << "bounds that are infinite prove nothing";
}

TEST(Tape, BoundsOfKnownFormulas) {
  Graph graph;
  const Expr u = graph.variable(0), v = graph.variable(1), p = graph.variable(2);
  const Expr outputs[] = {u * u, u * v, p * u + 1, Expr(4), u * u + v * v};
  std::array<Interval, 5> b;
  const double parameter = 2;
  Tape(graph, outputs).bound({-1, 2}, {-3, 1}, {&parameter, 1}, b);
  const Interval expected[] = {{0, 4}, {-6, 3}, {-1, 5}, {4, 4}, {0, 13}};
  for (int i = 0; i < 5; ++i) {
    EXPECT_NEAR(b[i].lo, expected[i].lo, 1e-14) << i;
    EXPECT_NEAR(b[i].hi, expected[i].hi, 1e-14) << i;
  }
  EXPECT_EQ(b[0].lo, 0) << "a square is never negative";
  EXPECT_EQ(b[3], Interval(4));
  for (const double wild : {std::nan(""), HUGE_VAL}) {
    Tape(graph, outputs).bound({-1, 2}, {-3, 1}, {&wild, 1}, b);
    EXPECT_EQ(b[2], Interval::everything());
    EXPECT_EQ(b[0], Interval(0, 4));
  }
}

TEST(TapeDeath, WantsItsParametersAndEqualCounts) {
  Graph graph;
  const Expr f = graph.variable(0) * graph.variable(3);
  const Tape tape(graph, {&f, 1});
  const double x[] = {1, 2};
  Interval bound;
  EXPECT_DEATH(static_cast<void>(tape.evaluate(x, x, {x, 1})), "1 versus 1");
  EXPECT_DEATH(tape.bound({0, 1}, {0, 1}, {x, 1}, {&bound, 1}), "1 versus 1");
  EXPECT_DEATH(static_cast<void>(tape.evaluate(x, {x, 1}, x)), "2 versus 1");
  EXPECT_DEATH(tape.evaluate(x, x, x, {}), "0 versus 1");
}

}  // namespace
}  // namespace luxo
