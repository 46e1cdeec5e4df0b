// SPDX-License-Identifier: Apache-2.0
// Where formulas are not smooth or not defined: limits of normals, kinks, holes.
#include <gtest/gtest.h>

#include <cmath>

#include "surface/library.h"
#include "surface/surface.h"

namespace luxo {
namespace {

TEST(Limits, TheRimOfTheTractricoidHasANormal) {
  // Su x Sv = -tanh u sech u n is zero all along u = 0, which is no point.
  const Surface s =
      surface([](auto u, auto v) { return point(cos(v) / cosh(u), sin(v) / cosh(u), u - tanh(u)); },
              {{0, 3}, {0, kTau}}, {.orientation = -1});
  EXPECT_EQ(s.topology().edge(0, Side::UMin).kind, Edge::Border);
  EXPECT_TRUE(s.topology().seamV());
  for (const double u : {0.0, 1e-300, 1e-14, 1e-12, 1e-9, 1e-3, 1.0})
    for (double v = 0; v < kTau; v += 0.7) {
      const Vec3 exact(std::tanh(u) * std::cos(v), std::tanh(u) * std::sin(v), 1 / std::cosh(u));
      // Su is the difference 1 - sech^2 u: near 0 its rounding, 1e-16, is compared with u.
      EXPECT_NEAR(glm::length(s.normal(u, v) - exact), 0, u > 1e-8 || u < 1e-11 ? 1e-10 : 1e-6)
          << u << ' ' << v;
    }
}

TEST(Limits, BothSidesOfACuspHaveOppositeNormals) {
  // The whole pseudosphere, folded at u = 0: one curve, one tangent plane, but the surface turns back.
  const auto half = [](double from, double to) {
    return surface([](auto u, auto v) { return point(cos(v) / cosh(u), sin(v) / cosh(u), u - tanh(u)); },
                   {{from, to}, {0, kTau}});
  };
  const Surface upper = half(0, 2), lower = half(-2, 0);
  const Surface s({upper.patches()[0], lower.patches()[0]});
  ASSERT_EQ(s.topology().joints.size(), 3u);
  for (const Joint& j : s.topology().joints)
    EXPECT_EQ(j.smooth, j.a.patch == j.b.patch) << "only the seams are smooth";
}

TEST(Limits, DegreeTwoIsExtrapolated) {
  // v^2 (cos, ., sin) and height v^4 / 2: the paraboloid y = r^2 / 2, whose Su x Sv vanishes with v^3.
  const Surface s =
      surface([](auto u, auto v) { return point(v * v * cos(u), pow(v, 4) / 2, v * v * sin(u)); },
              {{0, kTau}, {0, 1}});
  EXPECT_EQ(s.topology().edge(0, Side::VMin).kind, Edge::Pole);
  for (double u = 0; u < kTau; u += 0.5)
    EXPECT_NEAR(std::abs(s.normal(u, 0).y), 1, 1e-12) << "1 - y is the square of an angle below 1e-6";
}

TEST(Limits, InfiniteDerivativesLeaveANormal) {
  const Surface s = revolve([](auto v) { return ProfilePoint{sqrt(v), v}; });  // y = r^2
  EXPECT_EQ(s.topology().edge(0, Side::VMin).kind, Edge::Pole);
  for (const double v : {0.0, 1e-300, 1e-12, 1e-6, 0.25, 1.0}) {
    const double slope = 2 * std::sqrt(v);
    const Vec3 exact = unit(Vec3(slope, -1, 0));
    EXPECT_NEAR(glm::length(s.normal(0, v) - exact), 0, v < 1e-11 ? 5e-6 : 1e-12) << v;
  }
}

TEST(Limits, APlaceWithoutATangentPlaneStillHasAUnitVector) {
  const Surface s = surface([](auto u, auto v) { return point(u, u, u * v - u * v); }, {{0, 1}, {0, 1}});
  EXPECT_EQ(s.normal(0.5, 0.5), Vec3(0, 1, 0));
}

/// One patch, not cut where the formula is kinked.
template <class Formula>
Surface uncut(const Formula& formula, const Domain& domain) {
  Graph graph;
  const ExprPoint position = formula(graph.variable(0), graph.variable(1));
  return {compileSurface(graph, position), domain};
}

Surface creased() {
  return uncut([](auto u, auto v) { return point(u, abs(u), v); }, {{-1, 1}, {0, 1}});
}

TEST(Kinks, ACellAcrossACreaseIsKinked) {
  const Surface s = creased();
  const Surface::CellBounds across = s.boundCell(0, {{-0.5, 0.25}, {0, 1}}, {});
  EXPECT_TRUE(across.kinked);
  for (const double u : {-0.5, 0.0, 0.25}) EXPECT_TRUE(across.position.contains({u, std::abs(u), 0.5}));
  EXPECT_LE(across.position.extent().y, 0.5 + 1e-12);
  EXPECT_FALSE(s.boundCell(0, {{0.25, 0.5}, {0, 1}}, {}).kinked);
  EXPECT_TRUE(std::isinf(s.partialBounds({}).uu)) << "not bounded over the crease";
}

TEST(Kinks, ACreaseAlongACellsEdgeDoesNotCount) {
  const Surface s = creased();
  for (const Interval& u : {Interval(0, 0.5), Interval(-0.5, 0)}) {
    const Surface::CellBounds cell = s.boundCell(0, {u, {0, 1}}, {});
    EXPECT_FALSE(cell.kinked);
    EXPECT_EQ(cell.second.uu, 0) << "each half is flat";
  }
}

TEST(Kinks, AJumpAlongACellsEdgeCounts) {
  // floor takes its new value at the integer itself: the cell below it has that value on its last edge.
  const Surface stairs = uncut([](auto u, auto v) { return point(u, 0.5 * floor(u), v); }, {{0, 3}, {0, 1}});
  EXPECT_TRUE(stairs.boundCell(0, {{0.5, 1}, {0, 1}}, {}).kinked);
  EXPECT_FALSE(stairs.boundCell(0, {{1, 1.5}, {0, 1}}, {}).kinked);
  EXPECT_TRUE(stairs.boundCell(0, {{1.5, 2.5}, {0, 1}}, {}).kinked);
  EXPECT_FALSE(stairs.boundCell(0, {{1.25, 1.75}, {0, 1}}, {}).kinked);
  // Two pieces that meet: no jump. Two that do not: a jump.
  const auto pieces = [](double gap) {
    return uncut([=](auto u, auto v) { return point(u, select(less(u, 0.5), u * u, u / 2 + gap), v); },
                 {{0, 1}, {0, 1}});
  };
  EXPECT_FALSE(pieces(0).boundCell(0, {{0.25, 0.5}, {0, 1}}, {}).kinked);
  EXPECT_TRUE(pieces(0).boundCell(0, {{0.25, 0.75}, {0, 1}}, {}).kinked);
  EXPECT_TRUE(pieces(0.1).boundCell(0, {{0.25, 0.5}, {0, 1}}, {}).kinked);
}

TEST(Kinks, SmoothFormulasHaveNone) {
  const Surface s = torus(1, 0.25);
  EXPECT_TRUE(s.patches()[0].function->guardAtIntegers.empty());
  const Surface::CellBounds whole = s.boundCell(0, s.patchDomain(0), {});
  EXPECT_FALSE(whole.kinked);
  // Suu = 4 pi^2 (R + r cos) outward: at most 1.25 (2 pi)^2.
  EXPECT_GE(whole.second.uu, 1.25 * kTau * kTau);
  EXPECT_TRUE(whole.position.empty()) << "only filled when needed";
}

bool covers(const Domain& hole, double u, double v) { return hole.contains(u, v); }

TEST(Holes, TheLogarithmOfNegatives) {
  const Surface s = surface([](auto u, auto v) { return point(u, log(u), v); }, {{-1, 1}, {0, 2}});
  const std::vector<Domain> holes = s.holes({});
  ASSERT_EQ(holes.size(), 1u);
  EXPECT_EQ(holes[0].u.lo, -1);
  EXPECT_NEAR(holes[0].u.hi, 0, 1e-9);
  EXPECT_EQ(holes[0].v, Interval(0, 2));
  // It can be looked at, though it goes down without end.
  EXPECT_TRUE(std::isinf(s.bounds({}).min.y));
  const Box box = s.framing({});
  EXPECT_TRUE(std::isfinite(box.min.y));
  EXPECT_TRUE(box.contains({0.5, std::log(0.5), 1}));
}

TEST(Holes, CornersOutsideACircle) {
  const Surface s =
      surface([](auto u, auto v) { return point(u, sqrt(1.2 - u * u - v * v), v); }, {{-1, 1}, {-1, 1}});
  const std::vector<Domain> holes = s.holes({});
  ASSERT_EQ(holes.size(), 4u);
  for (const Domain& hole : holes) {
    // A corner whose sides are cut where u^2 + 1 = 1.2.
    EXPECT_TRUE(covers(hole, std::copysign(1, hole.u.mid()), std::copysign(1, hole.v.mid())));
    EXPECT_NEAR(hole.u.width(), 1 - std::sqrt(0.2), 1e-6);
    EXPECT_NEAR(hole.v.width(), 1 - std::sqrt(0.2), 1e-6);
  }
}

TEST(Holes, PolesBetweenSamplesAreFound) {
  const Surface s = surface([](auto u, auto v) { return point(u, 1 / (u - 1.0 / 3), v); }, {{0, 1}, {0, 1}});
  const std::vector<Domain> holes = s.holes({});
  ASSERT_EQ(holes.size(), 1u);
  EXPECT_TRUE(holes[0].u.contains(1.0 / 3)) << holes[0].u.lo << ' ' << holes[0].u.hi;
  EXPECT_LE(holes[0].u.width(), 1.0 / 64);
  EXPECT_NEAR(holes[0].v.lo, 0, 1e-5);
  EXPECT_NEAR(holes[0].v.hi, 1, 1e-5);
  // Nine points of ten are within a few units; the box to look at is not as large as the highest sample.
  const Box box = s.framing({});
  EXPECT_TRUE(box.contains({0.9, 1 / (0.9 - 1.0 / 3), 0.5}));
  EXPECT_LE(box.extent().y, 100);
}

TEST(Holes, LinesThatCrossAndFramesAreRectangles) {
  // u = 0 and v = 0: the line of v = 0 whole, that of u = 0 on both sides of it.
  const Surface cross = surface([](auto u, auto v) { return point(u, v, 1 / (u * v)); }, {{-1, 1}, {-1, 1}});
  const std::vector<Domain> lines = cross.holes({});
  EXPECT_EQ(lines.size(), 3u);
  for (const Domain& line : lines) EXPECT_LE(std::min(line.u.width(), line.v.width()), 1e-6);
  const Surface frame =
      surface([](auto u, auto v) { return point(u, acos(2 * u) + asin(2 * v), v); }, {{-1, 1}, {-1, 1}});
  double area = 0;
  for (const Domain& side : frame.holes({})) {
    EXPECT_FALSE(covers(side, 0, 0));
    area += side.u.width() * side.v.width();
  }
  EXPECT_NEAR(area, 4 - 1, 0.2) << "without the square in the middle; corners may count twice";
}

TEST(Holes, WhatIsJustDefinedHasNone) {
  // Intervals give up at u = 1 (a root of a number that may be negative by rounding); there is no hole.
  const Surface s = surface([](auto u, auto v) { return point(u, sqrt(1 - u * u), v); }, {{-1, 1}, {0, 1}});
  EXPECT_TRUE(s.holes({}).empty());
  for (const Surface& named : {sphere(1), torus(1, 0.3), cone(1, 0, 1)}) EXPECT_TRUE(named.holes({}).empty());
}

TEST(Holes, ASphereWithAHoleEnclosesNothing) {
  const auto ball = [](double low) {
    return surface(
        [=](auto u, auto v) {
          const auto hole = 0.01 * sqrt(cos(u) * cos(v) - low);
          return point((1 + hole) * (cos(v) * cos(u)), sin(v), -(cos(v) * sin(u)));
        },
        {{0.5, 0.5 + kTau}, {-kPi / 2, kPi / 2}});
  };
  EXPECT_TRUE(ball(-2).closed());
  EXPECT_FALSE(ball(-0.9).closed()) << "no number where cos u cos v < -0.9";
}

TEST(Holes, ASurfaceFiniteNowhereIsRefused) {
  // Half a surface is a surface; topology.RefusesWhatIsNoSurface has the rest.
  EXPECT_NO_THROW(static_cast<void>(
      surface([](auto u, auto v) { return point(sqrt(u), log(v), 1); }, {{-1, 1}, {-1, 1}})));
}

}  // namespace
}  // namespace luxo
