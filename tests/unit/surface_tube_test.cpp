// SPDX-License-Identifier: Apache-2.0
#include "surface/tube.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/error.h"

namespace luxo {
namespace {

/// Distance from the curve's point at u, and how far from perpendicular to its tangent, of the section at u.
void expectSections(const Surface& s, const std::function<Vec3(double)>& curve,
                    const std::function<double(double)>& radius) {
  const Interval range = s.domain().u;
  for (double part = 0; part <= 1; part += 1.0 / 64)
    for (double v = 0; v <= 1; v += 1.0 / 16) {
      const double u = range.lo + part * range.width();
      const Vec3 arm = s.position(u, v) - curve(u);
      EXPECT_NEAR(glm::length(arm), radius(u), 1e-12);
      // Central differences of the curve: h^2 / 6 of its third derivative, below 1e-7 here.
      const double h = 1e-4;
      const Vec3 tangent = unit(curve(u + h) - curve(u - h));
      EXPECT_NEAR(glm::dot(unit(arm), tangent), 0, 1e-6);
      // A section of constant radius is a circle whose normal is its arm.
      if (radius(range.lo) == radius(range.hi)) {
        EXPECT_NEAR(glm::length(s.normal(u, v) - unit(arm)), 0, 1e-12);
      }
    }
}

TEST(Tube, AroundACircleIsATorus) {
  const Surface s = tube([](auto u) { return point(2 * cos(u), 0, -2 * sin(u)); },
                         [](auto, auto) { return Expr(0.5); }, {0, kTau});
  EXPECT_TRUE(s.closed());
  EXPECT_EQ(s.topology().orientation(), 1) << "Su x Sv points outward";
  EXPECT_EQ(s.topology().eulerCharacteristic, 0);
  EXPECT_TRUE(s.topology().seamU() && s.topology().seamV());
  for (double u = 0; u <= kTau; u += 0.1)
    for (double v = 0; v <= 1; v += 0.1) {
      const Vec3 p = s.position(u, v);
      EXPECT_NEAR(std::hypot(std::hypot(p.x, p.z) - 2, p.y), 0.5, 1e-14);
    }
}

TEST(Tube, AKnotClosesSmoothly) {
  const auto curve = [](auto u) {
    const auto ring = 2 + cos(3 * u);
    return std::array{ring * cos(2 * u), sin(3 * u), ring * sin(2 * u)};
  };
  const Surface s = tube([&](Expr u) { return curve(u); }, [](auto, auto) { return Expr(0.3); }, {0, kTau},
                         {.name = "knot"});
  EXPECT_TRUE(s.topology().seamU() && s.topology().seamV());
  EXPECT_TRUE(s.closed());
  EXPECT_EQ(s.topology().orientation(), 1);
  expectSections(
      s,
      [&](double u) {
        using std::cos, std::sin;
        return Vec3((2 + cos(3 * u)) * cos(2 * u), sin(3 * u), (2 + cos(3 * u)) * sin(2 * u));
      },
      [](double) { return 0.3; });
}

TEST(Tube, StraightCurvesInAnyDirection) {
  // Curvature is zero: a Frenet frame would not exist. The axes themselves must not defeat the reference.
  for (const Vec3& way : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, -1), Vec3(1, 1, 1), Vec3(-3, 0.1, 2)}) {
    const Surface s = tube([&](auto u) { return point(way.x * u, way.y * u, way.z * u); },
                           [](auto, auto) { return Expr(0.25); }, {-1, 1});
    EXPECT_FALSE(s.topology().seamU());
    EXPECT_TRUE(s.topology().seamV());
    EXPECT_EQ(s.topology().eulerCharacteristic, 0);
    expectSections(
        s, [&](double u) { return way * u; }, [](double) { return 0.25; });
  }
}

TEST(Tube, TheRadiusMayVary) {
  const Surface horn = tube([](auto u) { return point(cos(u), 0.3 * u, sin(u)); },
                            [](auto u, auto) { return 0.05 * u; }, {0, 3 * kPi});
  EXPECT_TRUE(horn.topology().edge(0, Side::UMin).collapsed());
  expectSections(
      horn, [](double u) { return Vec3(std::cos(u), 0.3 * u, std::sin(u)); },
      [](double u) { return 0.05 * u; });
  const Surface ribbed = tube([](auto u) { return point(0, u, 0); },
                              [](auto, auto v) { return 1 + 0.1 * cos(5 * kTau * v); }, {0, 1});
  EXPECT_NEAR(glm::length(ribbed.position(0.5, 0.1) - Vec3(0, 0.5, 0)), 0.9, 1e-14);
}

TEST(Tube, ParametersMoveIt) {
  Graph graph;
  const Expr u = graph.variable(0), swing = graph.variable(2);
  const Surface s = tube(graph, point(u, swing * u * u, 0), 0.1, {0, 1}, {[](double t) { return t; }});
  ASSERT_EQ(s.parameters().size(), 1u);
  const double swung = 2;
  // The arm is perpendicular to the tangent (1, 4, 0) at u = 1.
  const Vec3 arm = s.position(1, 0.2, {&swung, 1}) - Vec3(1, 2, 0);
  EXPECT_NEAR(glm::length(arm), 0.1, 1e-14);
  EXPECT_NEAR(arm.x + 4 * arm.y, 0, 1e-14);
}

TEST(Tube, SaysWhereACurveHasNoDirection) {
  const auto refusal = [](const auto& curve) -> std::string {
    try {
      static_cast<void>(tube(curve, [](auto, auto) { return Expr(0.1); }, {-1, 1}, {.name = "pipe"}));
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::Scene);
      return error.what();
    }
    return {};
  };
  const std::string cusp = refusal([](auto u) { return point(u * u, u * u * u, 0); });
  EXPECT_NE(cusp.find("pipe"), std::string::npos) << cusp;
  EXPECT_NE(cusp.find("u = 0"), std::string::npos) << cusp;
  EXPECT_NE(refusal([](auto) { return point(1, 2, 3); }), "");
  EXPECT_NE(refusal([](auto u) { return point(u, log(u), 0); }), "");
}

}  // namespace
}  // namespace luxo
