// SPDX-License-Identifier: Apache-2.0
#include "surface/surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "surface/bezier.h"
#include "surface/catalogue.h"
#include "surface/surface_function.h"
#include "surface_samples.h"

namespace luxo {
namespace {

constexpr double kUlp = 0x1p-52;

/// Evenly spaced parameters, both ends included.
std::vector<double> evenly(const Interval& range, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i)
    values.push_back(std::min(range.hi, range.lo + range.width() * i / (count - 1)));
  values.back() = range.hi;
  return values;
}

TEST(Surface, NormalsEqualTheClosedForms) {
  // Everywhere, edges, poles and apexes included, and as near to them as 1e-9 of the domain.
  for (const SurfaceSample& sample : surfaceSamples()) {
    const Domain& d = sample.surface.domain();
    std::vector<double> us = evenly(d.u, 41), vs = evenly(d.v, 41);
    for (const double part : {1e-9, 1e-6, 1e-3}) {
      us.push_back(d.u.lo + part * d.u.width());
      vs.push_back(d.v.lo + part * d.v.width());
      vs.push_back(d.v.hi - part * d.v.width());
    }
    double worst = 0;
    for (const double u : us)
      for (const double v : vs) {
        const Vec3 n = sample.surface.normal(u, v, sample.parameters);
        ASSERT_NEAR(glm::length(n), 1, 4 * kUlp) << sample.name << " at " << u << ", " << v;
        worst = std::max(worst, glm::length(n - sample.normal(u, v)));
      }
    EXPECT_LE(worst, 1e-13) << sample.name;
  }
}

TEST(Surface, TangentsEqualCentralDifferences) {
  // Fourth order with h = 1e-3 of the domain: truncation h^4 S5 / 30 < 1e-8 of the surface's extent and
  // waves.
  for (const SurfaceSample& sample : surfaceSamples()) {
    const Domain& d = sample.surface.domain();
    const double hu = 1e-3 * d.u.width(), hv = 1e-3 * d.v.width();
    for (double s = 0.05; s < 1; s += 0.09)
      for (double t = 0.05; t < 1; t += 0.09) {
        const double u = d.u.lo + s * d.u.width(), v = d.v.lo + t * d.v.width();
        const auto at = [&](double x, double y) { return sample.surface.position(x, y, sample.parameters); };
        const Vec3 du =
            (8.0 * (at(u + hu, v) - at(u - hu, v)) - (at(u + 2 * hu, v) - at(u - 2 * hu, v))) / (12 * hu);
        const Vec3 dv =
            (8.0 * (at(u, v + hv) - at(u, v - hv)) - (at(u, v + 2 * hv) - at(u, v - 2 * hv))) / (12 * hv);
        const SurfacePoints p = sample.surface.evaluate({&u, 1}, {&v, 1}, sample.parameters);
        EXPECT_LE(glm::length(p.du[0] - du), 1e-7) << sample.name;
        EXPECT_LE(glm::length(p.dv[0] - dv), 1e-7) << sample.name;
        EXPECT_EQ(p.position[0], at(u, v));
      }
  }
}

TEST(Surface, GridsEqualPoints) {
  for (const SurfaceSample& sample : surfaceSamples()) {
    const auto us = evenly(sample.surface.domain().u, 7), vs = evenly(sample.surface.domain().v, 5);
    const SurfacePoints grid = sample.surface.evaluateGrid(us, vs, sample.parameters);
    for (std::size_t j = 0; j < vs.size(); ++j)
      for (std::size_t i = 0; i < us.size(); ++i) {
        const SurfacePoints p = sample.surface.evaluate({&us[i], 1}, {&vs[j], 1}, sample.parameters);
        EXPECT_EQ(grid.position[j * us.size() + i], p.position[0]);
        EXPECT_EQ(grid.du[j * us.size() + i], p.du[0]);
        EXPECT_EQ(grid.dv[j * us.size() + i], p.dv[0]);
      }
  }
}

TEST(Surface, PointsLieOnTheImplicitSurface) {
  const auto residual = [](const Surface& surface, const auto& implicit) {
    double worst = 0;
    for (const double u : evenly({0, 1}, 33))
      for (const double v : evenly({0, 1}, 33))
        worst = std::max(worst, std::abs(implicit(surface.position(u, v))));
    return worst;
  };
  EXPECT_LE(residual(sphere(1.25), [](const Vec3& p) { return glm::length(p) - 1.25; }), 4 * kUlp);
  EXPECT_LE(residual(torus(1, 0.25),
                     [](const Vec3& p) { return std::hypot(std::hypot(p.x, p.z) - 1, p.y) - 0.25; }),
            8 * kUlp);
  // y = (x^2 + z^2) / 4f; the error is relative to the height 1.8.
  EXPECT_LE(residual(paraboloid(0.2, 1.8), [](const Vec3& p) { return p.y - (p.x * p.x + p.z * p.z) / 0.8; }),
            16 * kUlp);
  EXPECT_LE(residual(cylinder(0.5, 3), [](const Vec3& p) { return std::hypot(p.x, p.z) - 0.5; }), 4 * kUlp);
  EXPECT_LE(
      residual(cone(1.5, 0.5, 2), [](const Vec3& p) { return std::hypot(p.x, p.z) - (1.5 - 0.5 * p.y); }),
      8 * kUlp);
  EXPECT_EQ(residual(disk(2), [](const Vec3& p) { return p.y; }), 0);
  // Corners and senses: u from +X toward -Z, v upward or outward.
  EXPECT_EQ(rectangle(3, 2).position(0, 0), Vec3(-1.5, 0, 1));
  EXPECT_EQ(rectangle(3, 2).position(1, 1), Vec3(1.5, 0, -1));
  EXPECT_EQ(cylinder(0.5, 3).position(0, 1), Vec3(0.5, 3, 0));
  EXPECT_NEAR(glm::length(cylinder(0.5, 3).position(0.25, 0) - Vec3(0, 0, -0.5)), 0, 1e-15);
  EXPECT_NEAR(glm::length(sphere(2).position(0.3, 0) - Vec3(0, -2, 0)), 0, 1e-15);
  EXPECT_EQ(disk(2).position(0, 1), Vec3(2, 0, 0));
}

TEST(Surface, FlagsCrossProductIsExact) {
  // Su x Sv = H (-K D cos(K u + phase), 0, W), each entry a product of a few rounded factors.
  const double W = 3, H = 2, D = 0.2, K = 8, phase = 0.7;
  const Surface s = flag({.width = W, .height = H, .depth = D, .waves = K, .phase = phase});
  for (double u = 0; u <= 1; u += 1.0 / 64)
    for (double v = 0; v <= 1; v += 0.25) {
      const SurfacePoints p = s.evaluate({&u, 1}, {&v, 1}, {});
      const Vec3 cross = glm::cross(p.du[0], p.dv[0]);
      EXPECT_NEAR(cross.x, -K * H * D * std::cos(K * u + phase), 4 * kUlp * K * H * D);
      EXPECT_EQ(cross.y, 0);
      EXPECT_EQ(cross.z, W * H);
    }
  EXPECT_TRUE(s.parameters().empty()) << "what does not move is part of the formula";

  const Surface moving = flag({.phase = [](double t) { return 2 * t; }});
  EXPECT_EQ(moving.parameters()[0].at(17), 34);
  EXPECT_FALSE(moving.parameters()[0].isConstant());
}

/// Random and evenly spaced parameters of the whole domain, edges included.
struct Parameters {
  std::vector<double> u, v;
};
Parameters dense(const Domain& d) {
  Parameters p;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> part(0, 1);
  for (const double u : evenly(d.u, 129))
    for (const double v : evenly(d.v, 129)) {
      p.u.push_back(u);
      p.v.push_back(v);
      p.u.push_back(std::min(d.u.hi, d.u.lo + part(random) * d.u.width()));
      p.v.push_back(std::min(d.v.hi, d.v.lo + part(random) * d.v.width()));
    }
  return p;
}

TEST(Surface, BoundsHoldTheSurfaceWithinTenPercent) {
  for (const SurfaceSample& sample : surfaceSamples()) {
    const Box bounds = sample.surface.bounds(sample.parameters);
    const Parameters p = dense(sample.surface.domain());
    Box tight;
    for (const Vec3& point : sample.surface.evaluate(p.u, p.v, sample.parameters).position) {
      ASSERT_TRUE(bounds.contains(point)) << sample.name;
      tight.add(point);
    }
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_LE(bounds.extent()[axis], 1.1 * tight.extent()[axis] + 1e-15)
          << sample.name << ", axis " << axis;
    EXPECT_EQ(sample.surface.bounds(sample.parameters), bounds);
  }
}

TEST(Surface, BoundsFollowTheParameters) {
  const Surface s = surface([](auto u, auto v, auto lift) { return point(u, lift, v); }, {}, {}, 0.0);
  EXPECT_NEAR(s.bounds(std::vector{2.0}).min.y, 2, 1e-15);
  EXPECT_NEAR(s.bounds(std::vector{5.0}).max.y, 5, 1e-14);
}

/// Lengths of Suu, Suv, Svv at every point, from a second compilation of the same formula.
template <class Formula>
PartialBounds sampledPartials(const Formula& formula, const Domain& domain, int freeVariables,
                              const std::vector<double>& parameters) {
  Graph graph;
  const Expr u = graph.variable(0), v = graph.variable(1);
  ExprPoint position;
  if constexpr (std::is_invocable_v<Formula, Expr, Expr>) {
    position = formula(u, v);
  } else {
    position = formula(u, v, graph.variable(2));
  }
  EXPECT_EQ(static_cast<int>(parameters.size()), freeVariables);
  const auto function = compileSurface(graph, position);
  const Parameters p = dense(domain);
  const auto d = function->second.evaluate(p.u, p.v, parameters);
  double largest[3] = {0, 0, 0};
  for (int k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < p.u.size(); ++i)
      largest[k] = std::max(largest[k], glm::length(Vec3(d[3 * k][i], d[3 * k + 1][i], d[3 * k + 2][i])));
  return {largest[0], largest[1], largest[2]};
}

void expectBound(const SurfaceSample& sample, const char* which, double bound, double supremum) {
  // Never below the true supremum (up to the rounding of the expected number), zero exactly where it is zero.
  const std::string what = sample.name + ", " + which;
  EXPECT_GE(bound, supremum * (1 - 8 * kUlp)) << what;
  if (supremum == 0) {
    EXPECT_EQ(bound, 0) << what;
    return;
  }
  // A user's formula may cost the splitting more rectangles than it is given.
  const bool named = sample.surface.name() == sample.name || sample.surface.name() == "cone";
  EXPECT_LE(bound, (named ? 1.1 : 1.25) * supremum * (1 + 1e-12)) << what;
  std::printf("%-18s%s: bound / supremum = %.4f\n", sample.name.c_str(), which, bound / supremum);
}

TEST(Surface, SecondDerivativesAreBoundedWithinTenPercent) {
  for (const SurfaceSample& sample : surfaceSamples()) {
    if (!sample.partials) continue;
    const PartialBounds bound = sample.surface.partialBounds(sample.parameters);
    expectBound(sample, "uu", bound.uu, sample.partials->uu);
    expectBound(sample, "uv", bound.uv, sample.partials->uv);
    expectBound(sample, "vv", bound.vv, sample.partials->vv);
  }
}

TEST(Surface, SecondDerivativesOfAnyFormulaStayBelowTheirBound) {
  const auto expectAbove = [](const auto& formula, const Domain& domain,
                              const std::vector<double>& parameters) {
    Surface s;
    if constexpr (std::is_invocable_v<decltype(formula), Expr, Expr>) {
      s = surface(formula, domain);
    } else {
      s = surface(formula, domain, {}, 0.0);
    }
    const PartialBounds bound = s.partialBounds(parameters);
    const PartialBounds taken =
        sampledPartials(formula, domain, static_cast<int>(parameters.size()), parameters);
    EXPECT_GE(bound.uu, taken.uu);
    EXPECT_GE(bound.uv, taken.uv);
    EXPECT_GE(bound.vv, taken.vv);
    std::printf("tightness %.3f %.3f %.3f\n", bound.uu / taken.uu, bound.uv / taken.uv, bound.vv / taken.vv);
  };
  expectAbove(
      [](auto u, auto v) {
        const auto q = 1 + v * cos(u);
        return point(q * cos(2 * u), q * sin(2 * u), v * v * sin(u));
      },
      {{0, kPi}, {-0.25, 0.25}}, {});
  expectAbove([](auto u, auto v) { return point(u, v, exp(-3 * (u * u + v * v)) * cos(4 * u * v)); },
              {{-1, 1}, {-1, 1}}, {});
  expectAbove([](auto u, auto v) { return point(cosh(u) * cos(v), cosh(u) * sin(v), u); },
              {{-1, 1}, {0, kTau}}, {});
  expectAbove([](auto u, auto v, auto p) { return point(u, v, sin(5 * u + p) / (2 + v)); }, {}, {1.2});
}

TEST(Surface, AnUnboundedSecondDerivativeHasAnInfiniteBound) {
  const Surface s = revolve([](auto v) { return ProfilePoint{sqrt(v), v}; });
  EXPECT_TRUE(std::isinf(s.partialBounds({}).vv));
  EXPECT_TRUE(s.bounds({}).contains({1, 1, 0}));
  for (const double v : {0.0, 1e-300, 0.5, 1.0}) {
    const Vec3 n = s.normal(0.3, v);
    EXPECT_NEAR(glm::length(n), 1, 4 * kUlp) << "at v = " << v;
  }
}

TEST(Surface, IdentityIsSharedByCopies) {
  const Surface a = sphere(1), b = sphere(2), copy = a;
  EXPECT_EQ(a.identity(), copy.identity());
  EXPECT_NE(a.identity(), b.identity());
  EXPECT_FALSE(Surface().valid());
  EXPECT_TRUE(a.valid());
  EXPECT_EQ(a.name(), "sphere");
}

BezierPatch net(double bent) {
  BezierPatch points;
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] = Vec3(static_cast<double>(i % 4), i == 5 ? bent : 0, static_cast<double>(i / 4));
  return points;
}

/// Which nobody can compare: each is made once.
std::shared_ptr<const SurfaceFunction> withOwnBounds(double most) {
  static std::map<double, std::shared_ptr<const SurfaceFunction>> made;
  std::shared_ptr<const SurfaceFunction>& function = made[most];
  if (function) return function;
  Graph graph;
  const Expr u = graph.variable(0), v = graph.variable(1);
  const auto second = [most](const Interval&, const Interval&, std::span<const double>) {
    return std::array{most, most, most};
  };
  return function = compileSurface(graph, {u, u * v, v}, {.second = second});
}

/// A surface of many that differ in one thing each.
Surface oneOf(int which) {
  const Domain square{{0, 1}, {0, 1}};
  const auto of = [&](double a, double b, const Domain& domain, SurfaceTraits traits, double parameter) {
    return surface([=](auto u, auto v, auto p) { return point(u, a * sin(u * v) + b, v + p * u * v); },
                   domain, std::move(traits), parameter);
  };
  switch (which) {
    case 0:
      return of(1, 0.5, square, {}, 2);
    case 1:
      return of(std::nextafter(1.0, 2.0), 0.5, square, {}, 2);
    case 2:
      return of(1, 0.25, square, {}, 2);
    case 3:
      return of(1, 0.5, {{0, 1}, {0, 2}}, {}, 2);
    case 4:
      return of(1, 0.5, square, {.name = "another"}, 2);
    case 5:
      return of(1, 0.5, square, {.orientation = -1}, 2);
    case 6:
      return of(1, 0.5, square, {}, 3);
    case 7:
      return of(1, 0.5, {{-0.0, 1}, {0, 1}}, {}, 2);
    case 8:
      return of(1, 0.5, square, {.borders = {{0, Side::UMin}}}, 2);
    case 9:
      return surface([](auto u, auto v) { return point(u, 1.0 * sin(u * v) + 0.5, v + 2.0 * u * v); },
                     square);
    case 10:
      return surface([](auto u, auto v, auto p) { return point(u, sin(u * v) + 0.5, v + p * v * v); }, square,
                     {}, 2.0);
    case 11:
      return surface([](auto u, auto v, auto p, auto) { return point(u, sin(u * v) + 0.5, v + p * u * v); },
                     square, {}, 2.0, 2.0);
    case 12:
      return bezier({net(0)});
    case 13:
      return bezier({net(1)});
    case 14:
      return bezier({net(0), net(1)});
    case 15:
      return bezier({net(1), net(0)});
    case 16:
      return of(1, 0.5, square, {.flatNormal = Vec3(0, 1, 0)}, 2);
    case 17:
      return of(1, 0.5, square, {.revolution = true}, 2);
    case 18:
      return of(1, 0.5, square, {.paraboloid = Paraboloid{1, 2}}, 2);
    case 19:
      return of(1, 0.5, square, {.paraboloid = Paraboloid{1, 3}}, 2);
    case 20:
      return torus(1, 0.25);
    case 21:
      return torus(1, 0.5);
    case 22:  // as a general form, and written out
      return makeSurface("sphere", {{"radius", {2}}});
    case 23: {
      const Surface known = makeSurface("sphere", {{"radius", {2}}});
      std::vector<Patch> patches = known.patches();
      for (Patch& patch : patches) patch.general.reset();
      return Surface(std::move(patches), {}, {.name = known.name(), .revolution = known.revolution()});
    }
    case 24:
      return Surface(withOwnBounds(1), square);
    case 25:
      return Surface(withOwnBounds(2), square);
    default: {  // two patches of one function, or of two that are equal
      const Surface whole = of(1, 0.5, square, {}, 2);
      const Surface upper = of(1, 0.5, {{0, 1}, {1, 2}}, {}, 2);
      Patch second = upper.patches()[0];
      if (which == 26) second.function = whole.patches()[0].function;
      return Surface({whole.patches()[0], second}, {Animated<double>(2.0)});
    }
  }
}

TEST(Surface, ThoseMadeAlikeAreOneAndNoOthers) {
  constexpr int kKinds = 28;
  std::vector<Surface> first, second;
  for (int i = 0; i < kKinds; ++i) first.push_back(oneOf(i));
  for (int i = 0; i < kKinds; ++i) second.push_back(oneOf(i));
  for (int i = 0; i < kKinds; ++i)
    for (int k = 0; k < kKinds; ++k)
      EXPECT_EQ(
          first[static_cast<std::size_t>(i)].identity() == second[static_cast<std::size_t>(k)].identity(),
          i == k)
          << i << ", " << k;
}

TEST(Surface, ThoseMadeAlikeKeepNoneAlive) {
  const auto held = [] {
    const Surface gone = oneOf(0);
    return std::weak_ptr<const SurfaceFunction>(gone.patches()[0].function);
  };
  EXPECT_TRUE(held().expired());
}

TEST(Surface, StatesWhatItIs) {
  ASSERT_TRUE(paraboloid(0.2, 1.8).paraboloid());
  EXPECT_EQ(paraboloid(0.2, 1.8).paraboloid()->focalLength, 0.2);
  EXPECT_EQ(paraboloid(0.2, 1.8).paraboloid()->height, 1.8);
  EXPECT_FALSE(sphere(1).paraboloid());
  EXPECT_EQ(rectangle(1, 2).flatNormal(), Vec3(0, 1, 0));
  EXPECT_EQ(disk(1).flatNormal(), Vec3(0, 1, 0));
  EXPECT_FALSE(cylinder(1, 1).flatNormal());
  EXPECT_TRUE(torus(1, 0.5).revolution());
  EXPECT_FALSE(rectangle(1, 2).revolution());
  EXPECT_FALSE(flag().revolution());
  for (const Surface& formula : {rectangle(1, 2), sphere(1), flag()}) {
    EXPECT_TRUE(formula.isParametric()) << formula.name();
    EXPECT_FALSE(formula.isPolygonal()) << formula.name();
  }
  EXPECT_FALSE(Surface().isParametric());
  EXPECT_FALSE(Surface().isPolygonal());
}

TEST(Surface, ParametersKeepTheirOrder) {
  const Surface s = surface([](auto u, auto v, auto a, auto b, auto c) { return point(u + a, v + b, c * u); },
                            {}, {}, 1.0, 2.0, [](double t) { return t; });
  std::vector<double> at5;
  for (const auto& parameter : s.parameters()) at5.push_back(parameter.at(5));
  EXPECT_EQ(at5, (std::vector<double>{1, 2, 5}));
  EXPECT_EQ(s.position(0.5, 0.25, at5), Vec3(1.5, 2.25, 2.5));
}

}  // namespace
}  // namespace luxo
