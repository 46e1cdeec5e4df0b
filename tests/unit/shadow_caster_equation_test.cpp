// SPDX-License-Identifier: Apache-2.0
// One equation stands for a surface that casts a shadow only where it is all of it.
#include <gtest/gtest.h>

#include <vector>

#include "shadow/caster_cache.h"
#include "surface/catalogue.h"
#include "surface/library.h"

namespace luxo::test {
namespace {

TEST(CasterEquation, IsOfOnePatchOrOfTheTwoSheetsOfAHyperboloid) {
  ASSERT_TRUE(casterEquation(sphere(1), {}));
  EXPECT_TRUE(casterEquation(sphere(1), {})->convex);
  const Surface sheets = makeSurface("hyperboloid2");
  ASSERT_EQ(sheets.patchCount(), 2U);
  const auto caster = casterEquation(sheets, {});
  ASSERT_TRUE(caster);
  EXPECT_EQ(caster->equation.sheet, 0);
}

// Where one ends nearer to the axis, the other's edges would let it go on.
TEST(CasterEquation, IsNotOfSheetsThatEndElsewhereOrOfOneTwice) {
  const Surface sheets = makeSurface("hyperboloid2");
  for (const std::uint32_t shorter : {0U, 1U}) {
    std::vector<Patch> patches = sheets.patches();
    Interval& v = patches[shorter].domain.v;
    (shorter == 0 ? v.lo : v.hi) = v.mid();
    EXPECT_FALSE(casterEquation(Surface(patches), {})) << shorter;
  }
  EXPECT_FALSE(casterEquation(Surface(std::vector{sheets.patches()[1], sheets.patches()[1]}), {}));
}

}  // namespace
}  // namespace luxo::test
