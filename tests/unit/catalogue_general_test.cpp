// SPDX-License-Identifier: Apache-2.0
// Named surfaces as formulas of their arguments: the same points as with the arguments folded in.
#include <gtest/gtest.h>

#include "draw/exact_shaders.h"
#include "support/other_arguments.h"
#include "surface/catalogue.h"
#include "surface/equation.h"

namespace luxo {
namespace {

/// Whether every patch's general form gives the patch's points.
void expectSamePoints(const Surface& surface, std::span<const double> parameters = {}) {
  double size = glm::length(surface.framing(parameters).extent());
  for (std::uint32_t i = 0; i < surface.patchCount(); ++i) {
    const Patch& patch = surface.patches()[i];
    ASSERT_TRUE(patch.general) << surface.name();
    const std::vector<double> inputs = patch.general->inputs(patch.constants, parameters);
    for (const double part : {0.0, 0.13, 0.5, 0.77, 1.0}) {
      const double u = patch.domain.u.lo + part * patch.domain.u.width();
      const double v = patch.domain.v.lo + (1 - part * part) * patch.domain.v.width();
      double p[3];
      patch.general->position.evaluatePoint(u, v, inputs, p);
      EXPECT_LE(glm::distance(Vec3(p[0], p[1], p[2]), surface.position(i, u, v, parameters)), 1e-13 * size)
          << surface.name() << " " << u << ", " << v;
    }
  }
}

/// Whether nothing needs to be compiled to search for the surface.
bool isCarried(const Surface& surface) {
  const auto equations = equationsOf(surface, {});
  for (std::uint32_t i = 0; i < surface.patchCount(); ++i)
    for (const GlslNumber number : {GlslNumber::Float, GlslNumber::Double}) {
      const auto& general = surface.patches()[i].general;
      const SurfaceCode code =
          general ? surfaceCode(*general, 0, number) : surfaceCode(*surface.patches()[i].function, 0, number);
      if (!equations[i] && builtInExactShader(code).empty()) return false;
    }
  return true;
}

TEST(GeneralForm, HasThePointsOfTheSurface) {
  for (const CatalogueEntry& entry : catalogue()) {
    if (entry.name == "teapot") continue;  // its control points are numbers of its patches anyway
    expectSamePoints(makeSurface(entry));
    expectSamePoints(makeSurface(entry, test::otherArguments(entry)));
  }
}

TEST(GeneralForm, IsCarriedForAllArguments) {
  for (const CatalogueEntry& entry : catalogue())
    EXPECT_TRUE(isCarried(makeSurface(entry, test::otherArguments(entry)))) << entry.name;
}

TEST(GeneralForm, SuperquadricsHaveOneForEveryKindOfExponent) {
  for (const char* name : {"superellipsoid", "supertoroid"})
    for (const double e : {0.3, 1.0, 1.7, 2.0})
      for (const double f : {0.3, 1.0, 1.7, 2.0}) {
        const Surface surface = makeSurface(name, {{"exponents", {e, f}}});
        expectSamePoints(surface);
        EXPECT_TRUE(isCarried(surface)) << name << " " << e << ", " << f;
      }
}

TEST(GeneralForm, ReadsWhatMoves) {
  const Surface flag = makeSurface("flag", {{"width", {3.0}}, {"phase", {[](double t) { return 2 * t; }}}});
  const double phase[] = {0.7};
  expectSamePoints(flag, phase);
  const Surface other = makeSurface("flag");
  EXPECT_EQ(surfaceCode(*flag.patches()[0].general, 0).glsl,
            surfaceCode(*other.patches()[0].general, 0).glsl);
}

}  // namespace
}  // namespace luxo
