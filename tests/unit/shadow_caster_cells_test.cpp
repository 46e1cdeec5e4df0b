// SPDX-License-Identifier: Apache-2.0
// Cells of casters cover their surfaces, and their bounds hold every point of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "shadow/caster_cells.h"
#include "surface/catalogue.h"
#include "surface/library.h"

namespace luxo {
namespace {

CasterCells cellsOf(const Surface& surface) {
  return makeCasterCells(surface, {}, CurvatureMap(surface, {}));
}

double area(const Domain& domain) { return domain.u.width() * domain.v.width(); }

/// What evaluations in double may be off by, of the distances involved.
constexpr double kRounding = 1e-13;

TEST(CasterCells, HoldEveryPointOfEveryNamedSurface) {
  for (const CatalogueEntry& entry : catalogue()) {
    const Surface surface = makeSurface(entry);
    const CasterCells caster = cellsOf(surface);
    std::vector<double> covered(surface.patchCount());
    std::mt19937 random(7);
    std::uniform_real_distribution<double> part(0, 1);
    for (const CasterCell& cell : caster.cells) {
      covered[cell.patch] += area(cell.domain);
      for (int k = 0; k < 8; ++k) {
        const double x = 2 * part(random) - 1, y = 2 * part(random) - 1;
        const double u = cell.domain.u.mid() + 0.5 * x * cell.domain.u.width(),
                     v = cell.domain.v.mid() + 0.5 * y * cell.domain.v.width();
        const Vec3 p = surface.position(cell.patch, u, v);
        if (!isFinite(p)) continue;
        const double slack = kRounding * (caster.size + glm::length(p));
        if (cell.proven()) {
          ASSERT_LE(glm::distance(p, cell.middle + x * cell.a + y * cell.b), cell.bend + slack) << entry.name;
        }
        ASSERT_TRUE(glm::all(glm::lessThanEqual(glm::abs(p - cell.middle), cell.reach + slack)))
            << entry.name;
      }
    }
    for (std::uint32_t patch = 0; caster.finite() && patch < surface.patchCount(); ++patch)
      EXPECT_NEAR(covered[patch] / area(surface.patchDomain(patch)), 1, 1e-9) << entry.name;
  }
}

/// Where a surface bends away from a side in all directions, all of a cell is on the other side of each of
/// its tangent planes.
TEST(CasterCells, LieBehindTheTangentPlanesOfTheSideThatTheyBendAwayFrom) {
  for (const CatalogueEntry& entry : catalogue()) {
    const Surface surface = makeSurface(entry);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> part(0, 1);
    for (const CasterCell& cell : cellsOf(surface).cells) {
      const int side = surface.bendsAwayFrom(cell.patch, cell.domain, {});
      if (side == 0) continue;
      std::vector<double> us, vs;
      for (int k = 0; k < 6; ++k) {
        us.push_back(std::lerp(cell.domain.u.lo, cell.domain.u.hi, part(random)));
        vs.push_back(std::lerp(cell.domain.v.lo, cell.domain.v.hi, part(random)));
      }
      const SurfacePoints at = surface.evaluate(cell.patch, us, vs, {});
      for (std::size_t i = 0; i < us.size(); ++i)
        for (std::size_t j = 0; j < us.size(); ++j) {
          if (i == j) continue;
          const Vec3 normal = glm::cross(at.du[i], at.dv[i]) * static_cast<double>(side);
          ASSERT_LT(glm::dot(normal, at.position[j] - at.position[i]), 0) << entry.name;
        }
    }
  }
}

TEST(CasterCells, BendAwayFromTheirOutsideWhereTheyAreConvex) {
  const auto partOf = [](const Surface& surface, int side) {
    const CasterCells caster = cellsOf(surface);
    return static_cast<double>(std::ranges::count_if(
               caster.cells,
               [&](const CasterCell& cell) {
                 return side * surface.topology().orientation(cell.patch) * cell.bendsAway > 0;
               })) /
           static_cast<double>(caster.cells.size());
  };
  // The outer half of a torus, by its angle, but for cells across its uppermost and lowest circle.
  EXPECT_NEAR(partOf(torus(2, 0.5), 1), 0.5, 0.15);
  EXPECT_EQ(partOf(torus(2, 0.5), -1), 0);
  EXPECT_GT(partOf(makeSurface("teapot"), 1), 0.25);
  for (const char* saddle : {"helicoid", "catenoid", "hyperbolic_paraboloid"}) {
    EXPECT_EQ(partOf(makeSurface(saddle), 1), 0) << saddle;
    EXPECT_EQ(partOf(makeSurface(saddle), -1), 0) << saddle;
  }
  EXPECT_EQ(partOf(sphere(1), 1), 0)
      << "no point of an ellipsoid that faces a light is in its shadow: nobody asks";
}

TEST(CasterCells, AreFlatAndFew) {
  for (const Surface& surface : {torus(2, 0.5), sphere(1), rectangle(3, 2)}) {
    const CasterCells caster = cellsOf(surface);
    EXPECT_LE(caster.cells.size(), 4096U);
    for (const CasterCell& cell : caster.cells) {
      EXPECT_TRUE(cell.proven());
      EXPECT_LE(cell.bend, kCellBend * caster.size * 1.001);
      EXPECT_LE(2 * glm::length(cell.a), kCellLength * caster.size * 1.001);
    }
  }
}

}  // namespace
}  // namespace luxo
