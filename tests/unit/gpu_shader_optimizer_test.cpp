// SPDX-License-Identifier: Apache-2.0
// What optimising a shader removes, and what it leaves alone.
#include "gpu/shader_optimizer.h"

#include "gpu/shader_compiler.h"
#include "luxo/shaders/surface_frag.h"
#include "luxo/shaders/surface_vert.h"
#include "shared/scene_data.h"
#include "support/spirv.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace luxo::gpu {
namespace {

using test::countOf;

constexpr std::uint32_t kName = 5, kFunction = 54, kFunctionCall = 57, kVariable = 59, kDecorate = 71;
constexpr std::uint32_t kAdd = 129, kSubtract = 131, kMultiply = 133;
constexpr std::uint32_t kNoContraction = 42, kFunctionStorage = 7;

std::vector<std::uint32_t> compiled(const std::string& body, std::string_view shared = {}) {
  const std::string text =
      "#version 460\nlayout(location = 0) in float x;\nlayout(location = 0) out float y;\n" + body;
  return ShaderCompiler(std::filesystem::path())
      .compile({.source = {"test.frag", text}, .sharedFunction = shared})
      .spirv;
}

TEST(ShaderOptimizer, LeavesOneFunctionOfValues) {
  const auto words = compiled(R"(
float twice(float a) { float b = a; b = b + a; return b; }
float once(float a, out float b) { b = twice(a); return a; }
void main() { float b; y = once(x, b); y = y > 0.0 ? twice(b) : b; })");
  EXPECT_EQ(countOf(words, {kFunction}), 1u);
  EXPECT_EQ(countOf(words, {kFunctionCall}), 0u);
  EXPECT_EQ(countOf(words, {kName}), 0u);
  std::size_t local = 0;
  test::forEachInstruction(words, [&](const test::Instruction& i) {
    local += i.operation == kVariable && i.words[3] == kFunctionStorage;
  });
  EXPECT_EQ(local, 0u);
}

TEST(ShaderOptimizer, KeepsInputsThatNobodyReads) {
  constexpr std::uint32_t kInput = 1;
  std::size_t inputs = 0;
  test::forEachInstruction(compiled("void main() { y = 1.0; }"), [&](const test::Instruction& i) {
    inputs += i.operation == kVariable && i.words[3] == kInput;
  });
  EXPECT_EQ(inputs, 1u) << "x";
}

TEST(ShaderOptimizer, DoesNotFoldArithmetic) {
  const auto words = compiled("void main() { float a = x + 0.1; a = a + 0.2; a = a * 3.0; y = a * 0.0; }");
  EXPECT_EQ(countOf(words, {kAdd}), 2u);
  EXPECT_EQ(countOf(words, {kMultiply}), 2u);
}

TEST(ShaderOptimizer, WhatIsPreciseStaysPrecise) {
  const auto words = compiled(R"(
float rest(float a, float b) { precise float sum = a + b, part = sum - a, left = b - part; return left; }
float both(float a) { return rest(rest(a, 1e-8), rest(1.0, a)); }
void main() { precise float z = both(x) * both(2.5); y = z; })");
  std::set<std::uint32_t> precise;
  test::forEachInstruction(words, [&](const test::Instruction& i) {
    if (i.operation == kDecorate && i.words[2] == kNoContraction) precise.insert(i.words[1]);
  });
  std::size_t operations = 0;
  test::forEachInstruction(words, [&](const test::Instruction& i) {
    if (i.operation != kAdd && i.operation != kSubtract && i.operation != kMultiply) return;
    ++operations;
    EXPECT_TRUE(precise.contains(i.words[2])) << "operation " << i.operation;
  });
  EXPECT_GT(operations, 10u);
}

TEST(ShaderOptimizer, ASharedFunctionIsOptimisedOnceAndInlinedEverywhere) {
  const std::string body = R"(
float part(const float a) { float r = fract(a); return r * r + r; }
float formula(const float a) { return part(a) + part(2.0 * a) * part(a); }
void main() { float z = x; for (int i = 0; i < 4; ++i) z = formula(z); y = formula(z) - formula(x); })";
  const auto words = compiled(body, "formula");
  constexpr std::uint32_t kFract = 10;
  EXPECT_EQ(countOf(words, {kFunction}), 1u);
  EXPECT_EQ(test::callsOf(words, kFract), 3u * 2u) << "part(a) once in each";
  EXPECT_EQ(test::instructionsIn(words), test::instructionsIn(compiled(body)));
}

std::size_t variablesOf(std::span<const std::uint32_t> words, std::uint32_t storage) {
  std::size_t count = 0;
  test::forEachInstruction(
      words, [&](const test::Instruction& i) { count += i.operation == kVariable && i.words[3] == storage; });
  return count;
}

TEST(ShaderOptimizer, StripsWhatConstantsLeaveUnusedFromBothStages) {
  constexpr std::uint32_t kInput = 1, kOutput = 3, kSpecConstantTrue = 48;
  const auto strippedWith = [](std::uint32_t carries, std::uint32_t facetNormal) {
    return stripped(luxo_surface_vert, luxo_surface_frag,
                    std::vector<SpecializationConstant>{{shared::kConstantPlainLights, 1},
                                                        {shared::kConstantCarries, carries},
                                                        {shared::kConstantFacetNormal, facetNormal}});
  };
  const ShaderStages all = strippedWith(1, 0), few = strippedWith(0, 0), fewest = strippedWith(0, 1);
  EXPECT_GE(variablesOf(all.fragment, kInput), 9U);
  EXPECT_EQ(variablesOf(few.fragment, kInput), 4U) << "position, normal, numbers, which face it is";
  EXPECT_EQ(variablesOf(few.vertex, kOutput), 4U) << "with gl_Position";
  EXPECT_EQ(variablesOf(fewest.fragment, kInput), 3U) << "no normal";
  EXPECT_EQ(variablesOf(fewest.vertex, kOutput), 3U);
  EXPECT_EQ(variablesOf(few.fragment, kOutput), 1U);
  EXPECT_EQ(countOf(few.fragment, {kSpecConstantTrue}), 0U);
}

}  // namespace
}  // namespace luxo::gpu
