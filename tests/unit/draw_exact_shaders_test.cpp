// SPDX-License-Identifier: Apache-2.0
// The exact shaders that luxo carries.
#include "draw/exact_shaders.h"

#include <gtest/gtest.h>

#include <array>

#include "draw/exact_source.h"
#include "gpu/shader_optimizer.h"
#include "luxo/shaders/exact_vert.h"
#include "scene/pattern.h"
#include "shared/bindings.h"
#include "support/spirv.h"
#include "surface/caster_code.h"
#include "surface/catalogue.h"

namespace luxo {
namespace {

constexpr char32_t kSpirvMagic = 0x07230203, kSpirv16 = 0x00010600;

std::u32string_view carriedFor(const Surface& surface, std::uint32_t patch = 0,
                               GlslNumber number = GlslNumber::Float) {
  const std::optional<Equation> equation = equationsOf(surface, {})[patch];
  return builtInExactShader(equation ? equationCode(equation->form(), 0, number)
                                     : surfaceCode(*surface.patches()[patch].function, 0, number));
}

TEST(ExactShaders, EveryNamedSurfaceIsCarried) {
  for (const CatalogueEntry& entry : catalogue()) {
    const Surface surface = makeSurface(entry);
    for (std::uint32_t patch = 0; patch < surface.patchCount(); ++patch)
      for (const GlslNumber number : {GlslNumber::Float, GlslNumber::Double}) {
        const auto words = carriedFor(surface, patch, number);
        ASSERT_GT(words.size(), 5u) << entry.name;
        EXPECT_EQ(words[0], kSpirvMagic) << entry.name;
        EXPECT_EQ(words[1], kSpirv16) << entry.name;
      }
  }
}

TEST(ExactShaders, EachFormulaHasItsOwn) {
  const Surface knot = makeSurface("torus_knot"), klein = makeSurface("klein");
  EXPECT_NE(carriedFor(knot).data(), carriedFor(klein).data());
  EXPECT_NE(carriedFor(knot).data(), carriedFor(knot, 0, GlslNumber::Double).data());
}

TEST(ExactShaders, ShadowsOfNamedSurfacesAreCarried) {
  SurfaceCodes codes;
  for (const CatalogueEntry& entry : catalogue()) {
    const CasterCode found = casterCode(codes, makeSurface(entry), {});
    const auto words = builtInCasterShader(ExactSource::Caster::Shadow, *found.code);
    ASSERT_GT(words.size(), 5u) << entry.name;
    EXPECT_EQ(words[0], kSpirvMagic) << entry.name;
  }
}

TEST(ExactShaders, EquationsShareTheirs) {
  const Surface ball = makeSurface("sphere"), tube = makeSurface("cylinder"), ring = makeSurface("torus");
  EXPECT_EQ(carriedFor(ball).data(), carriedFor(tube).data());
  EXPECT_NE(carriedFor(ball).data(), carriedFor(ring).data());
}

TEST(ExactShaders, OtherFormulasHaveNone) {
  const Surface surface = luxo::surface([](auto u, auto v) { return point(u, v, sin(0.7316 * u)); }, {});
  EXPECT_TRUE(carriedFor(surface).empty());
  const Surface sphere = makeSurface("sphere");
  const Pattern stripes = pattern([](auto u, auto v) { return point(u, v, mod(floor(7.316 * u), 2)); });
  EXPECT_TRUE(builtInExactShader(surfaceCode(*sphere.patches()[0].function, 0), stripes.glsl()).empty());
  // What comes before all and what comes after all in the table.
  EXPECT_TRUE(builtInExactShader({.glsl = ""}).empty());
  EXPECT_TRUE(builtInExactShader({.glsl = "~"}).empty());
}

/// The sum of so many sines, each of another multiple of u.
Surface sines(int count) {
  return luxo::surface(
      [count](auto u, auto v) {
        auto sum = sin(u);
        for (int k = 2; k <= count; ++k) sum = sum + sin(static_cast<double>(k) * u);
        return point(u, sum, v);
      },
      {});
}

std::vector<std::uint32_t> compiledFor(int count, bool grazing, GlslNumber number = GlslNumber::Float) {
  const SurfaceCode code = surfaceCode(*sines(count).patches()[0].function, 0, number);
  return gpu::ShaderCompiler(std::filesystem::path()).compile(ExactSource(code, {}, grazing).desc()).spirv;
}

TEST(ExactShaders, HaveAFormulaOnceForEveryLoopThatNeedsIt) {
  constexpr std::uint32_t kRound = 1;
  const auto calls = [](int count, bool grazing, bool walks) {
    const std::array constants{gpu::SpecializationConstant{shared::kConstantWalks, walks}};
    return test::callsOf(gpu::stripped(luxo_exact_vert, compiledFor(count, grazing), constants).fragment,
                         kRound);
  };
  const auto added = [&](bool grazing, bool walks) {
    return calls(30, grazing, walks) - calls(20, grazing, walks);
  };
  EXPECT_EQ(added(false, false), 10u) << "where rays do not graze, and what they meet is certain: one loop";
  EXPECT_EQ(added(false, true), 2 * 10u) << "where it is walked to: Newton's steps, and what certifies";
  EXPECT_EQ(added(true, true), 3 * 10u) << "the approach, the trace, and what certifies";
}

TEST(ExactShaders, GrowLinearlyWithTheFormula) {
  for (const GlslNumber number : {GlslNumber::Float, GlslNumber::Double}) {
    const auto size = [&](int count) {
      return static_cast<double>(test::instructionsIn(compiledFor(count, true, number)));
    };
    const double few = size(10), some = size(20), many = size(40);
    EXPECT_NEAR(many - some, 2 * (some - few), 0.01 * (many - some));
  }
}

TEST(ExactShaders, FormulasTooLargeHaveNone) {
  EXPECT_FALSE(surfaceCode(*sines(300).patches()[0].function, 0).isTooLarge());
  EXPECT_TRUE(surfaceCode(*sines(500).patches()[0].function, 0).isTooLarge());
}

}  // namespace
}  // namespace luxo
