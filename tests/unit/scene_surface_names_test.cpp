// SPDX-License-Identifier: Apache-2.0
// What colours may say about their surface, against closed forms and the curvature of exact derivatives.
#include "scene/surface_names.h"

#include <gtest/gtest.h>

#include <string>

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
  for (const char* name : {"torus", "catenoid", "klein"}) {
    const Surface surface = makeSurface(name);
    const double u = surface.domain().u.lo + 0.37 * surface.domain().u.width(), v = surface.domain().v.lo + 0.61 * surface.domain().v.width();
    const std::uint32_t patch = surface.patchAt(u, v);
    const auto k = curvatureAt(surface, patch, u, v, {});
    const Vec3 p = surface.position(u, v), n = surface.normal(u, v);
    const double expected[] = {p.x, p.y, p.z, n.x, n.y, n.z, k->gaussian, k->mean, k->k1, k->k2};
    const std::vector<double> values = valuesAt(surface, u, v);
    for (std::size_t i = 0; i < values.size(); ++i)
      EXPECT_NEAR(values[i], expected[i], 1e-9) << name << ": " << kSurfaceNames[i];
  }
}

}  // namespace
}  // namespace luxo
