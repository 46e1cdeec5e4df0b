// SPDX-License-Identifier: Apache-2.0
// The degree of formulas, and that nothing of low degree is hidden between places that are close together.
#include "formula/degree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "math/numbers.h"
#include "math/sampling.h"

namespace luxo {
namespace {

Vec2 degreeOf(auto&& formula, const Vec2& width = Vec2(1)) {
  Graph graph;
  const std::array root{Expr(formula(graph.variable(0), graph.variable(1)))};
  return degreesOf(graph, root, width)[0];
}

TEST(Degree, IsThatOfPowersAndWholeTurns) {
  EXPECT_EQ(degreeOf([](Expr, Expr) { return Expr(3); }), Vec2(0));
  EXPECT_EQ(degreeOf([](Expr u, Expr v) { return 2 * u - v / 3; }), Vec2(1));
  EXPECT_EQ(degreeOf([](Expr u, Expr v) { return pow(u, 3) * v + v * v; }), Vec2(3, 2));
  EXPECT_EQ(degreeOf([](Expr u, Expr v) { return sqrt(1 + v * v) * u; }), Vec2(1, 2));
  const Vec2 turns = degreeOf([](Expr u, Expr v) { return v * cos(kTau * u) + sin(3 * (kPi * v - u)); });
  EXPECT_NEAR(turns.x, 1, 1e-15);
  EXPECT_NEAR(turns.y, 1.5, 1e-15);
  EXPECT_NEAR(degreeOf([](Expr u, Expr v) { return sin(u) + v; }, {kTau, 5}).x, 1, 1e-15);
}

TEST(Degree, IsInfiniteWhereSomethingMayBeNarrow) {
  const auto hasNone = [](auto&& formula) { return !(degreeOf(formula).x <= 1e9); };
  EXPECT_TRUE(hasNone([](Expr u, Expr) { return exp(-1e6 * u * u); }));
  EXPECT_TRUE(hasNone([](Expr u, Expr) { return 1 / (1 + 1e6 * u * u); }));
  EXPECT_TRUE(hasNone([](Expr u, Expr) { return tanh(1e3 * u); }));
  EXPECT_TRUE(hasNone([](Expr u, Expr) { return abs(u); }));
  EXPECT_TRUE(hasNone([](Expr u, Expr v) { return sin(u * v); }));
  EXPECT_TRUE(hasNone([](Expr u, Expr) { return pow(u, -1); }));
  Graph graph;
  const std::array root{graph.variable(2)};
  EXPECT_FALSE(degreesOf(graph, root, Vec2(1))[0].x <= 1e9);
}

TEST(Period, IsSeenInHowAFormulaIsWritten) {
  const auto periodic = [](auto&& formula, int variable, double width) {
    Graph graph;
    const std::array root{Expr(formula(graph.variable(0), graph.variable(1)))};
    return isPeriodic(graph, root, variable, width);
  };
  const auto ring = [](Expr u, Expr v) { return (2 + cos(v)) * exp(sin(3 * u + 2 * v)); };
  EXPECT_TRUE(periodic(ring, 0, kTau));
  EXPECT_TRUE(periodic(ring, 1, kTau));
  EXPECT_TRUE(periodic(ring, 0, kTau / 3));
  EXPECT_TRUE(periodic(ring, 0, 6.2832));
  EXPECT_FALSE(periodic(ring, 0, 1));
  const auto spiral = [](Expr u, Expr v) { return u * cos(u) + sin(v / 2); };
  EXPECT_FALSE(periodic(spiral, 0, kTau));
  EXPECT_FALSE(periodic(spiral, 1, kTau));
  EXPECT_TRUE(periodic(spiral, 1, 2 * kTau));
  // A dent that is not there on the other side of the seam.
  EXPECT_FALSE(
      periodic([](Expr u, Expr v) { return cos(u) + sin(v) * exp(-pow((u - 0.1) / 0.016, 2)); }, 0, kTau));
}

// What surface/equation.h concludes: sums of degree 4 in each variable that are small at its 400 places are
// small everywhere. Their coefficients are random; the worst of 200 is a fifth larger than it is there.
TEST(Degree, WhatIsLowIsSmallWhereItIsSmallAtSomePlaces) {
  std::mt19937 random(3);
  std::normal_distribution<double> coefficient;
  constexpr int kDegree = 4;
  // 1, t, .. t^4, and the sine and cosine of up to 4 turns.
  const auto basis = [](double t) {
    std::array<double, 3 * kDegree + 1> values{1};
    for (int k = 1; k <= kDegree; ++k) {
      values[k] = values[k - 1] * t;
      values[kDegree + k] = std::sin(kTau * k * t);
      values[2 * kDegree + k] = std::cos(kTau * k * t);
    }
    return values;
  };
  std::vector<std::pair<std::array<double, 13>, std::array<double, 13>>> places, everywhere;
  for (int k = 0; k < 400; ++k) {
    const Vec2 p = quasirandomPoint(k);
    places.emplace_back(basis(p.x), basis(p.y));
  }
  for (int i = 0; i <= 60; ++i)
    for (int j = 0; j <= 60; ++j) everywhere.emplace_back(basis(i / 60.0), basis(j / 60.0));
  for (int round = 0; round < 200; ++round) {
    std::array<std::array<double, 13>, 13> c;
    for (auto& row : c)
      for (double& one : row) one = coefficient(random);
    const auto largest = [&](const auto& at) {
      double most = 0;
      for (const auto& [u, v] : at) {
        double sum = 0;
        for (int i = 0; i < 13; ++i)
          for (int j = 0; j < 13; ++j) sum += c[i][j] * u[i] * v[j];
        most = std::max(most, std::abs(sum));
      }
      return most;
    };
    EXPECT_LE(largest(everywhere), 3 * largest(places));
  }
}

}  // namespace
}  // namespace luxo
