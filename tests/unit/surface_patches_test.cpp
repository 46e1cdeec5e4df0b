// SPDX-License-Identifier: Apache-2.0
// Surfaces of several patches, and edges that are joined in every way there is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "surface/surface.h"
#include "surface/topology.h"

namespace luxo {
namespace {

/// One patch of a generic formula `(auto u, auto v) -> point`.
template <class Formula>
Patch patchOf(const Formula& formula, const Domain& domain) {
  Graph graph;
  const ExprPoint position = formula(graph.variable(0), graph.variable(1));
  return {compileSurface(graph, position), domain};
}

ExprPoint times(const ExprPoint& p, Expr factor) { return {p[0] * factor, p[1] * factor, p[2] * factor}; }
ExprPoint onUnitSphere(const ExprPoint& p) {
  return times(p, 1 / sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]));
}

/// The faces of a cube, blown up to a sphere; in every second one u and v have changed places.
std::vector<Patch> cubeSphere() {
  std::vector<Patch> faces;
  for (int face = 0; face < 6; ++face) {
    const double lower = 3 * face - 1, sign = face % 2 == 0 ? 1 : -1;
    faces.push_back(patchOf(
        [&](Expr u, Expr v) {
          const Expr s = u - (lower + 1);
          ExprPoint p{s, v, sign};
          std::rotate(p.begin(), p.begin() + face / 2, p.end());
          return onUnitSphere(p);
        },
        {{lower, lower + 2}, {-1, 1}}));
  }
  return faces;
}

TEST(Patches, SixFacesMakeASphere) {
  const Surface s(cubeSphere(), {}, {.name = "cube sphere"});
  const Topology& t = s.topology();
  EXPECT_EQ(s.patchCount(), 6u);
  EXPECT_EQ(t.joints.size(), 12u);
  EXPECT_EQ(t.eulerCharacteristic, 2);
  EXPECT_TRUE(t.closed && t.orientable && t.borderless);
  EXPECT_FALSE(t.seamU() || t.seamV()) << "no patch wraps around on its own";
  for (const Joint& j : t.joints) EXPECT_TRUE(j.smooth && !j.flipped);
  // Half the faces' cross products point inward; all normals point outward.
  EXPECT_EQ(std::ranges::count(t.orientations, 1), 3);
  for (std::uint32_t k = 0; k < 6; ++k)
    for (double a = -1; a <= 1; a += 0.25)
      for (double v = -1; v <= 1; v += 0.25) {
        const double u = 3 * k + a;
        EXPECT_NEAR(glm::length(s.normal(k, u, v) - s.position(k, u, v)), 0, 1e-14);
        if (std::abs(a) < 1) {
          EXPECT_EQ(s.position(u, v), s.position(k, u, v));
        }
      }
  // The hull of the domains; bounds that hold the whole sphere, within the few percent that they promise.
  EXPECT_EQ(s.domain(), (Domain{{-1, 16}, {-1, 1}}));
  const Box box = s.bounds({});
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_LE(box.min[axis], -1);
    EXPECT_GE(box.max[axis], 1);
    EXPECT_LE(box.extent()[axis], 2.6);
  }
}

TEST(Patches, AJointNamesTheSamePoints) {
  const Surface s(cubeSphere());
  for (const Joint& j : s.topology().joints)
    for (double part = 0; part <= 1; part += 1.0 / 32) {
      const EdgePoint a = edgePoint(s.patchDomain(j.a.patch), j.a.side, part);
      const EdgePoint b = edgePoint(s.patchDomain(j.b.patch), j.b.side, j.reversed ? 1 - part : part);
      EXPECT_NEAR(glm::length(s.position(j.a.patch, a.u, a.v) - s.position(j.b.patch, b.u, b.v)), 0, 1e-15);
    }
}

TEST(Patches, ACappedCylinderIsClosedButNotSmooth) {
  const auto circle = [](Expr radius, Expr u, Expr y) {
    return point(radius * cos(kTau * u), y, -(radius * sin(kTau * u)));
  };
  const Surface s({patchOf([&](Expr u, Expr v) { return circle(v, u, 0); }, {{0, 1}, {0, 1}}),
                   patchOf([&](Expr u, Expr v) { return circle(1, u, v - 1); }, {{0, 1}, {1, 3}}),
                   patchOf([&](Expr u, Expr v) { return circle(4 - v, u, 2); }, {{0, 1}, {3, 4}})});
  const Topology& t = s.topology();
  EXPECT_EQ(t.eulerCharacteristic, 2);
  EXPECT_TRUE(t.closed && t.orientable);
  ASSERT_EQ(t.joints.size(), 5u);
  EXPECT_EQ(std::ranges::count_if(t.joints, [](const Joint& j) { return j.smooth; }), 3) << "the seams";
  EXPECT_EQ(t.edge(0, Side::VMin).kind, Edge::Pole);
  EXPECT_EQ(t.edge(2, Side::VMax).kind, Edge::Pole);
  EXPECT_EQ(s.normal(0, 0.3, 0), Vec3(0, -1, 0));
  EXPECT_EQ(s.normal(2, 0.3, 4), Vec3(0, 1, 0));
  EXPECT_NEAR(glm::length(s.normal(1, 0.25, 2) - Vec3(0, 0, -1)), 0, 1e-15);
}

TEST(Patches, KleinsFigureEight) {
  const Surface s = surface(
      [](auto u, auto v) {
        const auto q = 2 + cos(u / 2) * sin(v) - sin(u / 2) * sin(2 * v);
        return point(q * cos(u), q * sin(u), sin(u / 2) * sin(v) + cos(u / 2) * sin(2 * v));
      },
      {{0, kTau}, {0, kTau}});
  const Topology& t = s.topology();
  EXPECT_EQ(t.eulerCharacteristic, 0);
  EXPECT_TRUE(t.borderless);
  EXPECT_FALSE(t.orientable || t.closed);
  ASSERT_EQ(t.joints.size(), 2u);
  for (const Joint& j : t.joints) {
    EXPECT_TRUE(j.smooth);
    const bool along = j.a.side == Side::UMin || j.a.side == Side::UMax;  // (2 pi, v) is (0, -v)
    EXPECT_EQ(j.reversed, along);
    EXPECT_EQ(j.flipped, along);
  }
}

/// Boy's surface after Apery; v = pi / 2 is one point inside, so it is made of the two sides of it.
Surface boy() {
  const auto formula = [](Expr u, Expr v) {
    const Expr root = std::sqrt(2.0), scale = 1 / (2 - root * sin(3 * u) * sin(2 * v)), c2 = pow(cos(v), 2);
    return times(point(root * cos(2 * u) * c2 + cos(u) * sin(2 * v),
                       root * sin(2 * u) * c2 - sin(u) * sin(2 * v), 3 * c2),
                 scale);
  };
  return Surface({patchOf(formula, {{-kPi / 2, kPi / 2}, {0, kPi / 2}}),
                  patchOf(formula, {{-kPi / 2, kPi / 2}, {kPi / 2, kPi}})},
                 {}, {.name = "boy"});
}

TEST(Patches, BoysSurface) {
  const Surface s = boy();
  const Topology& t = s.topology();
  EXPECT_EQ(t.eulerCharacteristic, 1);
  EXPECT_TRUE(t.borderless);
  EXPECT_FALSE(t.orientable || t.closed);
  EXPECT_EQ(t.joints.size(), 3u);
  for (const Joint& j : t.joints) EXPECT_TRUE(j.smooth);
  // The collapsed edge lies at the origin, its limit normal on the axis.
  EXPECT_EQ(t.edge(0, Side::VMax).kind, Edge::Pole);
  EXPECT_EQ(t.edge(1, Side::VMin).kind, Edge::Pole);
  EXPECT_NEAR(std::abs(t.edge(0, Side::VMax).normal.z), 1, 1e-14);
  EXPECT_NEAR(std::abs(t.edge(1, Side::VMin).normal.z), 1, 1e-14);
}

TEST(Patches, TwoBallsAreTwoWholes) {
  // The second one's formula points inward; each is measured on its own.
  const auto ball = [](double x, double turn) {
    return
        [=](Expr u, Expr v) { return point(x + cos(v) * cos(turn * u), sin(v), -(cos(v) * sin(turn * u))); };
  };
  const Surface s({patchOf(ball(-2, 1), {{0, kTau}, {-kPi / 2, kPi / 2}}),
                   patchOf(ball(2, -1), {{10, 10 + kTau}, {-kPi / 2, kPi / 2}})});
  EXPECT_EQ(s.topology().orientations, (std::vector<double>{1, -1}));
  EXPECT_TRUE(s.closed());
  EXPECT_EQ(s.topology().eulerCharacteristic, 4);
  EXPECT_NEAR(glm::length(s.normal(1, 10, 0) - unit(s.position(1, 10, 0) - Vec3(2, 0, 0))), 0, 1e-14);
}

TEST(Patches, ThreePagesOnOneEdgeAreNoInside) {
  const auto page = [](double angle) {
    return [=](Expr u, Expr v) {
      return point((u - std::floor(angle)) * std::cos(angle), v, (u - std::floor(angle)) * std::sin(angle));
    };
  };
  std::vector<Patch> pages;
  for (const double angle : {0.5, 2.5, 4.5})
    pages.push_back(patchOf(page(angle), {{std::floor(angle), std::floor(angle) + 1}, {0, 1}}));
  const Topology t = Surface(pages).topology();
  EXPECT_EQ(t.joints.size(), 2u);
  for (const Joint& j : t.joints) EXPECT_FALSE(j.smooth || j.flipped);
  for (std::uint32_t k = 0; k < 3; ++k) EXPECT_EQ(t.edge(k, Side::UMin).kind, Edge::Seam);
  EXPECT_FALSE(t.closed || t.borderless);
  EXPECT_EQ(t.eulerCharacteristic, 1) << "a book can be shrunk to a point";
}

TEST(Patches, PolesMayLieOnAnySide) {
  const Surface s = surface([](auto u, auto v) { return point(cos(u) * cos(v), sin(u), cos(u) * sin(v)); },
                            {{-kPi / 2, kPi / 2}, {0, kTau}});
  const Topology& t = s.topology();
  EXPECT_EQ(t.edge(0, Side::UMin).kind, Edge::Pole);
  EXPECT_EQ(t.edge(0, Side::UMax).kind, Edge::Pole);
  EXPECT_TRUE(t.seamV());
  EXPECT_TRUE(s.closed());
  EXPECT_EQ(t.eulerCharacteristic, 2);
  for (double v = 0; v < kTau; v += 0.5) {
    EXPECT_NEAR(glm::length(s.normal(-kPi / 2, v) - Vec3(0, -1, 0)), 0, 1e-14);
    EXPECT_NEAR(glm::length(s.normal(kPi / 2, v) - Vec3(0, 1, 0)), 0, 1e-14);
  }
  // An apex on a u edge: half-angle 45 degrees.
  const Surface cone =
      surface([](auto u, auto v) { return point(u * cos(v), u, u * sin(v)); }, {{0, 1}, {0, kTau}});
  EXPECT_EQ(cone.topology().edge(0, Side::UMin).kind, Edge::Apex);
  EXPECT_NEAR(std::abs(glm::dot(cone.normal(0, 1), unit(Vec3(std::cos(1), -1, std::sin(1))))), 1, 1e-14);
}

TEST(Patches, ADomainTypedByHandCloses) {
  const auto pipe = [](double end) {
    return surface([](auto u, auto v) { return point(cos(u), v, sin(u)); }, {{0, end}, {0, 1}}).topology();
  };
  EXPECT_TRUE(pipe(6.283185307).seamU());
  EXPECT_FALSE(pipe(6.2832).seamU());
}

TEST(Patches, WavesThatMeetAtEvenPlacesAreNotJoined) {
  // The edges u = 0 and u = 1 meet 32 times on the way, at evenly spaced places.
  const Topology t =
      surface([](auto u, auto v) { return point(u * (1 - u), v, 0.1 * (u * sin(32 * kPi * v))); },
              {{0, 1}, {0, 1}})
          .topology();
  EXPECT_EQ(t.edge(0, Side::UMin).kind, Edge::Border);
  EXPECT_EQ(t.edge(0, Side::UMax).kind, Edge::Border);
}

TEST(Patches, ParametersCanBeExchanged) {
  const Surface s = surface([](auto u, auto v, auto lift) { return point(u, lift, v); }, {}, {}, 0.0);
  const Surface lifted = s.withParameters({[](double t) { return 3 * t; }});
  EXPECT_EQ(lifted.identity(), s.identity());
  EXPECT_EQ(lifted.parameters()[0].at(2), 6);
  EXPECT_EQ(s.parameters()[0].at(2), 0) << "the original keeps its own";
}

TEST(Patches, AConstantTellsPatchesOfOneFunctionApart) {
  Graph graph;
  const Expr u = graph.variable(0), v = graph.variable(1), shift = graph.variable(2),
             lift = graph.variable(3);
  const auto function = compileSurface(graph, point(u + shift, lift, v));
  const Surface s({{function, {{0, 1}, {0, 1}}, {5}}, {function, {{1, 2}, {0, 1}}, {-5}}}, {0.5});
  const double two = 2;
  EXPECT_EQ(s.position(0, 0.5, 0.25, {&two, 1}), Vec3(5.5, 2, 0.25));
  EXPECT_EQ(s.position(1, 1.5, 0.25, {&two, 1}), Vec3(-3.5, 2, 0.25));
  EXPECT_EQ(s.bounds({&two, 1}).extent().y, s.boundPosition(0, {{0, 1}, {0, 1}}, {&two, 1}).extent().y);
  EXPECT_TRUE(s.bounds({&two, 1}).contains({-4, 2, 0}));
}

}  // namespace
}  // namespace luxo
