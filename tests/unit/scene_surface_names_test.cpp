// SPDX-License-Identifier: Apache-2.0
// What colours may say about their surface, against closed forms and the curvature of exact derivatives.
#include "scene/surface_names.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "formula/tape.h"
#include "surface/catalogue.h"
#include "surface/curvature.h"
#include "surface/library.h"

namespace luxo {
namespace {

std::vector<double> valuesAt(const Surface& surface, double u, double v) {
  Graph graph;
  const Tape tape(graph, surfaceValues(graph, surface, 2));
  std::vector<double> values(kSurfaceNames.size());
  tape.evaluatePoint(u, v, {}, values);
  return values;
}

TEST(SurfaceNames, OfABallAreItsRadiusUpToThePole) {
  for (const double v : {0.0, 1e-9, 0.3, 1.0}) {
    const std::vector<double> values = valuesAt(sphere(0.5), 0.2, v);
    for (const std::size_t i : {6, 7, 8, 9}) EXPECT_NEAR(values[i], i == 6 ? 4 : 2, 1e-6) << v;
  }
}

TEST(SurfaceNames, AreThePlaceNormalAndCurvatureOfTheSurface) {
  // Of the pot 28 patches share a formula; of the folds each of 11 has its own.
  const Surface folds = surface(
      [](auto u, auto v) { return point(u, abs(mod(5 * u, 2) - 1) * (1 + v * v), v); }, {{-1, 1}, {-1, 1}});
  for (const Surface& surface :
       {makeSurface("torus"), makeSurface("catenoid"), makeSurface("klein"), makeSurface("teapot"), folds}) {
    std::uint32_t k = 0;
    for (const Patch& patch : surface.patches()) {
      const double u = patch.domain.u.lo + 0.37 * patch.domain.u.width(),
                   v = patch.domain.v.lo + 0.61 * patch.domain.v.width();
      const auto bend = curvatureAt(surface, k, u, v, {});
      const Vec3 p = surface.position(u, v), n = surface.normal(u, v);
      const double expected[] = {p.x,        p.y,      p.z,     n.x, n.y, n.z, bend->gaussian,
                                 bend->mean, bend->k1, bend->k2};
      const std::vector<double> values = valuesAt(surface, u, v);
      for (std::size_t i = 0; i < values.size(); ++i)
        EXPECT_NEAR(values[i], expected[i], 1e-9 * std::max(1.0, std::abs(expected[i])))
            << kSurfaceNames[i] << " of patch " << k << " of " << surface.patchCount();
      ++k;
    }
  }
}

}  // namespace
}  // namespace luxo
