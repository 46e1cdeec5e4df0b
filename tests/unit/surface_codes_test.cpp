// SPDX-License-Identifier: Apache-2.0
// Codes of surfaces: shared by equal formulas, and forgotten with the last that has them.
#include <gtest/gtest.h>

#include "surface/library.h"
#include "surface/surface_code.h"

namespace luxo {
namespace {

Surface wave(double k, std::string name = "wave") {
  return surface([k](auto u, auto v) { return point(u, sin(k * u), v); }, {{0, 1}, {0, 1}},
                 {.name = std::move(name)});
}

const std::shared_ptr<const SurfaceFunction>& functionOf(const Surface& surface) {
  return surface.patches()[0].function;
}

TEST(SurfaceCodes, EqualFormulasShareOne) {
  SurfaceCodes codes;
  const Surface a = wave(3), b = wave(3, "another"), c = wave(4);
  ASSERT_NE(functionOf(a), functionOf(b));
  EXPECT_EQ(codes.get(functionOf(a), 0), codes.get(functionOf(b), 0));
  EXPECT_NE(codes.get(functionOf(a), 0), codes.get(functionOf(c), 0));
  EXPECT_EQ(codes.count(), 2u);
}

TEST(SurfaceCodes, AreForgottenWithTheirFormulas) {
  SurfaceCodes codes;
  for (int edit = 1; edit <= 100; ++edit) {
    const Surface edited = wave(edit);
    EXPECT_NE(codes.get(functionOf(edited), 0), nullptr);
  }
  EXPECT_LE(codes.count(), 2u) << "the last, and one that went when it came";
}

TEST(SurfaceCodes, WhoHasOneKeepsIt) {
  SurfaceCodes codes;
  SurfaceCodePtr kept;
  {
    const Surface first = wave(1);
    kept = codes.get(functionOf(first), 0);
  }
  const Surface other = wave(2), again = wave(1);
  static_cast<void>(codes.get(functionOf(other), 0));
  EXPECT_EQ(codes.get(functionOf(again), 0), kept) << "equal formulas have one code";
}

}  // namespace
}  // namespace luxo
