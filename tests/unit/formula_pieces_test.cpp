// SPDX-License-Identifier: Apache-2.0
// Formulas with kinks fall into their smooth pieces.
#include "formula/pieces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "formula/tape.h"
#include "math/vec.h"
#include "surface/surface.h"

namespace luxo {
namespace {

class FormulaPieces : public testing::Test {
 protected:
  std::vector<double> lines(Expr f, std::uint32_t axis, const Interval& range) {
    return kinkLines(graph_, std::span(&f, 1), axis, range);
  }
  double at(Expr f, double u, double v) {
    double value = 0;
    Tape(graph_, std::span(&f, 1)).evaluatePoint(u, v, {}, {&value, 1});
    return value;
  }

  Graph graph_;
  Expr u_ = graph_.variable(0), v_ = graph_.variable(1);
};

TEST_F(FormulaPieces, LinesAreFoundToTheLastBit) {
  EXPECT_EQ(lines(abs(u_), 0, {-1, 1}), std::vector<double>{0});
  EXPECT_EQ(lines(abs(u_), 1, {-1, 1}), std::vector<double>{});
  EXPECT_EQ(lines(abs(u_ - 0.3) + max(v_, 0.7), 0, {-1, 1}), std::vector<double>{0.3});
  EXPECT_EQ(lines(abs(u_ - 0.3) + max(v_, 0.7), 1, {-1, 1}), std::vector<double>{0.7});
  EXPECT_EQ(lines(smoothstep(0.25, 0.5, v_), 1, {0, 1}), (std::vector<double>{0.25, 0.5}));
  EXPECT_EQ(lines(floor(4 * u_), 0, {0, 1}), (std::vector<double>{0.25, 0.5, 0.75}));
  const std::vector<double> zeros = lines(abs(sin(3 * u_)), 0, {0.1, 3});
  ASSERT_EQ(zeros.size(), 2U);  // pi/3 and 2 pi/3
  EXPECT_NEAR(zeros[0], kPi / 3, 4e-15);
  EXPECT_NEAR(zeros[1], 2 * kPi / 3, 4e-15);
}

TEST_F(FormulaPieces, EdgesAreNoLines) {
  EXPECT_EQ(lines(abs(u_), 0, {0, 1}), std::vector<double>{});
  EXPECT_EQ(lines(max(u_, 1), 0, {0, 1}), std::vector<double>{});
}

TEST_F(FormulaPieces, WhatCannotBeCutIsLeftWhole) {
  EXPECT_EQ(lines(abs(u_ - v_), 0, {-1, 1}), std::vector<double>{});                  // a diagonal
  EXPECT_EQ(lines(abs(u_ - graph_.variable(2)), 0, {-1, 1}), std::vector<double>{});  // it moves
  EXPECT_EQ(lines(floor(1000 * u_), 0, {0, 1}), std::vector<double>{});               // too many
  EXPECT_EQ(lines(abs(max(u_, 0) * 0.5), 0, {-1, 1}), std::vector<double>{});         // zero all along
}

// On every part between lines the piece has no choices left and the values of the whole.
TEST_F(FormulaPieces, PiecesAreTheFormulaWithoutItsChoices) {
  const Expr f = abs(u_ - 0.25) * min(v_, 0.5) + select(less(u_, 0), sin(u_), u_ * u_) + sign(v_ - 0.5) +
                 floor(2 * u_) + mod(v_, 0.25) + clamp(u_, -0.5, 0.5) + smoothstep(0, 1, v_);
  const Interval range(-1, 1);
  std::vector<double> us = lines(f, 0, range), vs = lines(f, 1, range);
  EXPECT_EQ(us, (std::vector<double>{-0.5, 0, 0.25, 0.5}));
  EXPECT_EQ(vs, (std::vector<double>{-0.75, -0.5, -0.25, 0, 0.25, 0.5, 0.75}));
  for (std::vector<double>* list : {&us, &vs}) {
    list->insert(list->begin(), -1);
    list->push_back(1);
  }
  std::mt19937 random(5);
  std::uniform_real_distribution<double> part(0.001, 0.999);
  for (std::size_t i = 0; i + 1 < us.size(); ++i)
    for (std::size_t j = 0; j + 1 < vs.size(); ++j) {
      const Interval u(us[i], us[i + 1]), v(vs[j], vs[j + 1]);
      const std::vector<Expr> piece = pieceOf(graph_, std::span(&f, 1), u, v);
      EXPECT_TRUE(graph_.kinks(piece).empty()) << u.lo << ' ' << v.lo;
      for (int k = 0; k < 20; ++k) {
        const double x = u.lo + part(random) * u.width(), y = v.lo + part(random) * v.width();
        EXPECT_NEAR(at(piece[0], x, y), at(f, x, y), 1e-14);  // sums may be ordered anew
      }
    }
}

// A choice that is not made alike all over the rectangle stays.
TEST_F(FormulaPieces, OpenChoicesStay) {
  const Expr f = abs(u_ - v_);
  EXPECT_EQ(graph_.kinks(pieceOf(graph_, std::span(&f, 1), {0, 1}, {0, 1})).size(), 1U);
  EXPECT_TRUE(graph_.kinks(pieceOf(graph_, std::span(&f, 1), {0, 1}, {2, 3})).empty());
}

// A pyramid: four smooth patches that meet in creases, with the apex where the formula has it.
TEST_F(FormulaPieces, ARoofHasCreases) {
  const Surface roof =
      surface([](auto u, auto v) { return point(u, 1 - abs(u) - 0.5 * abs(v), -v); }, {{-1, 1}, {-1, 1}});
  ASSERT_EQ(roof.patchCount(), 4U);
  EXPECT_EQ(roof.topology().joints.size(), 4U);
  for (const Joint& joint : roof.topology().joints) EXPECT_FALSE(joint.smooth);
  EXPECT_EQ(roof.partialBounds({}).uu, 0);
  for (std::uint32_t patch = 0; patch < 4; ++patch) {
    const Domain& d = roof.patchDomain(patch);
    const double su = d.u.hi > 0 ? 1 : -1, sv = d.v.hi > 0 ? 1 : -1;
    const Vec3 normal = glm::normalize(Vec3(su, 1, -0.5 * sv));
    // At the crease itself, the apex: each patch has its own side's normal.
    EXPECT_LT(glm::length(roof.normal(patch, 0, 0) - normal), 1e-15) << patch;
  }
}

}  // namespace
}  // namespace luxo
