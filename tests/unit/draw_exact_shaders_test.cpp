// SPDX-License-Identifier: Apache-2.0
// The exact shaders that luxo carries.
#include "draw/exact_shaders.h"

#include <gtest/gtest.h>

#include "surface/catalogue.h"

namespace luxo {
namespace {

constexpr std::uint32_t kSpirvMagic = 0x07230203, kSpirv16 = 0x00010600;

std::span<const std::uint32_t> carriedFor(const Patch& patch) {
  return builtInExactShader(surfaceCode(*patch.function, patch.constants.size()));
}

TEST(ExactShaders, EveryNamedSurfaceIsCarried) {
  for (const CatalogueEntry& entry : catalogue()) {
    const Surface surface = makeSurface(entry);
    for (const Patch& patch : surface.patches()) {
      const auto words = carriedFor(patch);
      ASSERT_GT(words.size(), 5u) << entry.name;
      EXPECT_EQ(words[0], kSpirvMagic) << entry.name;
      EXPECT_EQ(words[1], kSpirv16) << entry.name;
    }
  }
}

TEST(ExactShaders, EachFormulaHasItsOwn) {
  const Surface sphere = makeSurface("sphere"), torus = makeSurface("torus");
  EXPECT_NE(carriedFor(sphere.patches()[0]).data(), carriedFor(torus.patches()[0]).data());
}

TEST(ExactShaders, OtherFormulasHaveNone) {
  const Surface surface = luxo::surface([](auto u, auto v) { return point(u, v, sin(0.7316 * u)); }, {});
  EXPECT_TRUE(carriedFor(surface.patches()[0]).empty());
  const Surface sphere = makeSurface("sphere");
  const Pattern stripes = pattern([](auto u, auto v) { return point(u, v, mod(floor(7.316 * u), 2)); });
  EXPECT_TRUE(builtInExactShader(surfaceCode(*sphere.patches()[0].function, 0), stripes).empty());
  // What comes before all and what comes after all in the table.
  EXPECT_TRUE(builtInExactShader({.glsl = ""}).empty());
  EXPECT_TRUE(builtInExactShader({.glsl = "~"}).empty());
}

}  // namespace
}  // namespace luxo
