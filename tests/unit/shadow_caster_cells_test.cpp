// SPDX-License-Identifier: Apache-2.0
// Cells of casters cover their surfaces, and their bounds hold every point of them.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

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
