// SPDX-License-Identifier: Apache-2.0
// Which surfaces are equations, and that an equation's points are the formula's.
#include "surface/equation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/equation_names.h"
#include "surface/catalogue.h"
#include "surface/library.h"
#include "surface/surface_code.h"

namespace luxo {
namespace {

/// A ball of that radius, of a part of its meridian.
Surface ballUpTo(double latest) {
  return surface(
      [](auto u, auto v) {
        const Expr latitude = kPi * (v - 0.5), turn = kTau * u;
        return point(0.7 * cos(latitude) * cos(turn), 0.7 * sin(latitude),
                     -(0.7 * cos(latitude) * sin(turn)));
      },
      {{0, 1}, {0, latest}});
}

TEST(Equation, QuadricsAndTheTorusHaveOne) {
  for (const CatalogueEntry& entry : catalogue()) {
    const Surface surface = makeSurface(entry);
    for (const std::optional<Equation>& equation : equationsOf(surface, {}))
      EXPECT_EQ(equation.has_value(), test::kEquationNames.contains(std::string(entry.name))) << entry.name;
  }
}

TEST(Equation, IsWhereTheFormulaIs) {
  for (const Surface& surface :
       {torus(3, 0.25), cylinder(0.3, 7), cone(2, 0.5, 0.1), makeSurface("ellipsoid"), disk(5),
        rectangle(3, 0.2), paraboloid(0.4, 3), makeSurface("hyperboloid"), makeSurface("hyperboloid2"),
        makeSurface("hyperbolic_paraboloid")}) {
    for (std::uint32_t patch = 0; patch < surface.patchCount(); ++patch) {
      const std::optional<Equation> equation = equationOf(surface, patch, {});
      ASSERT_TRUE(equation) << surface.name();
      const Domain& domain = surface.patchDomain(patch);
      for (const double s : {0.1, 0.37, 0.84})
        for (const double t : {0.15, 0.5, 0.9}) {
          const double u = domain.u.lo + s * domain.u.width(), v = domain.v.lo + t * domain.v.width();
          const Vec3 p = surface.position(patch, u, v) / equation->scale;
          EXPECT_NEAR(equation->at(p), 0, 1e-14) << surface.name();
          EXPECT_NEAR(equation->parametersOf(p).x, u, 1e-14) << surface.name();
          EXPECT_NEAR(equation->parametersOf(p).y, v, 1e-14) << surface.name();
          // Outside F has the sign it says.
          const Vec3 out = surface.position(patch, u, v) + 1e-4 * surface.normal(patch, u, v);
          EXPECT_GT(equation->at(out / equation->scale) * equation->outward, 0) << surface.name();
        }
    }
  }
}

TEST(Equation, ASurfaceOfManyNumbersIsKnownAtEach) {
  const Surface grows =
      surface([](auto u, auto v,
                 auto radius) { return point(radius * cos(kTau * u), 2 * v, -(radius * sin(kTau * u))); },
              {}, {}, 1.5);
  for (const double radius : {0.5, 1.5, 20.0}) {
    const std::optional<Equation> equation = equationOf(grows, 0, std::array{radius});
    ASSERT_TRUE(equation);
    EXPECT_DOUBLE_EQ(equation->scale.x, radius);
  }
}

// A meridian or a circle is taken whole: a part of one is another surface.
TEST(Equation, PartsOfWhatIsWholeHaveNone) {
  EXPECT_TRUE(equationOf(ballUpTo(1), 0, {}));
  EXPECT_FALSE(equationOf(ballUpTo(0.5), 0, {}));
}

// A dent that lies between most samplings.
TEST(Equation, AKinkedBallHasNone) {
  const Surface dented = surface(
      [](auto u, auto v) {
        const Expr latitude = kPi * (v - 0.5), turn = kTau * u;
        const Expr r = 0.7 + 0.05 * max(0, 1 - 4000 * ((u - 0.3) * (u - 0.3) + (v - 0.6) * (v - 0.6)));
        return point(r * cos(latitude) * cos(turn), r * sin(latitude), -(r * cos(latitude) * sin(turn)));
      },
      {});
  for (std::uint32_t patch = 0; patch < dented.patchCount(); ++patch)
    EXPECT_FALSE(equationOf(dented, patch, {})) << patch;
}

// It is 1 / 300 of the sheet wide: no samplings would find all of its kind.
TEST(Equation, ASmoothNeedleIsNone) {
  const auto needle = [](auto u, auto v, double height) {
    return height * exp(-1e6 * ((u - 0.513) * (u - 0.513) + (v - 0.377) * (v - 0.377)));
  };
  const auto sheet = [&](double height) {
    return surface([=](auto u, auto v) { return point(2 * (u - 0.5), needle(u, v, height), -2 * (v - 0.5)); },
                   {});
  };
  const auto tube = [&](double height) {
    return surface(
        [=](auto u, auto v) {
          const Expr r = 0.7 + needle(u, v, height);
          return point(r * cos(kTau * u), v, -(r * sin(kTau * u)));
        },
        {});
  };
  EXPECT_FALSE(equationOf(sheet(0.2), 0, {}));
  EXPECT_TRUE(equationOf(sheet(0), 0, {}));
  EXPECT_FALSE(equationOf(tube(0.2), 0, {}));
  EXPECT_TRUE(equationOf(tube(0), 0, {}));
  // Nor is a wave whose zeros the places may be.
  EXPECT_FALSE(equationOf(
      surface([](auto u, auto v) { return point(2 * (u - 0.5), 1e-13 * sin(60 * u), -2 * (v - 0.5)); }, {}),
      0, {}));
}

TEST(Equation, AllOfAFormSharesItsCode) {
  SurfaceCodes codes;
  using enum Equation::Form;
  EXPECT_EQ(codes.get(Quadric, 20), codes.get(Quadric, 20));
  EXPECT_NE(codes.get(Quadric, 20), codes.get(Torus, 20));
  EXPECT_NE(codes.get(Quadric, 20), codes.get(Quadric, 20, GlslNumber::Double));
}

}  // namespace
}  // namespace luxo
