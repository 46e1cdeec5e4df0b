// SPDX-License-Identifier: Apache-2.0
// What a program costs a driver: counted by hand, and what doubles with each function.
#include "gpu/shader_cost.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "gpu/shader_compiler.h"

namespace luxo::gpu {
namespace {

ShaderCost costOfText(const std::string& declared, const std::string& value) {
  const std::string text =
      "#version 460\nlayout(location = 0) out float o;\nlayout(location = 0) in float i;\n" + declared +
      "void main() { o = " + value + "; }\n";
  return costOf(ShaderCompiler("").compile({.source = {"a.glsl", text}, .forReflection = true}).spirv);
}

TEST(ShaderCost, VariablesAreThoseOfEveryCopy) {
  EXPECT_EQ(costOfText("", "i").variableBytes, 0U);
  EXPECT_EQ(costOfText("float a[5]; mat3 m;\n", "a[1] + m[0].x").variableBytes, 20U + 36U);
  const std::string f = "float f() { vec4 b[2][3]; return b[1][2].x; }\n";
  EXPECT_EQ(costOfText(f, "f()").variableBytes, 96U);
  EXPECT_EQ(costOfText(f, "f() + f()").variableBytes, 192U);
  EXPECT_EQ(costOfText(f + "float g() { return f() + f(); }\n", "g() + g()").variableBytes, 384U);
}

TEST(ShaderCost, InstructionsAreThoseOfEveryCopy) {
  const std::string f = "float f() { return sin(i) * cos(i); }\n";
  const std::uint64_t none = costOfText(f, "i").instructions, one = costOfText(f, "f()").instructions,
                      two = costOfText(f, "f() + f()").instructions;
  EXPECT_GT(one, none + 5);
  // The second call, and the sum.
  EXPECT_GT(two - one, one - none);
  std::string doubling = f;
  for (int k = 0; k < 60; ++k) {
    const std::string name = k == 0 ? "f" : "f" + std::to_string(k);
    doubling += "float f" + std::to_string(k + 1) + "() { return " + name + "() + " + name + "(); }\n";
  }
  EXPECT_EQ(costOfText(doubling, "f60()").instructions, 1'000'000'000'000'000U);
}

TEST(ShaderCost, HugeArraysDoNotWrap) {
  EXPECT_EQ(costOfText("float a[100000][100000][100000];\n", "a[1][2][int(i)]").variableBytes,
            1'000'000'000'000'000U);
}

TEST(ShaderCost, TablesHaveTheElementsOfAllTheirArrays) {
  EXPECT_EQ(costOfText("", "vec2(1.0, 2.0).y").longestTable, 0U);
  EXPECT_EQ(costOfText("const float t[3] = float[3](1, 2, 4);\n", "t[int(i)]").longestTable, 3U);
  EXPECT_EQ(
      costOfText("const float t[2][3] = float[2][3](float[3](1, 2, 4), float[3](8, 9, 7));\n", "t[int(i)][2]")
          .longestTable,
      6U);
}

/// Counted by hand.
TEST(ShaderCost, NestingIsThatOfBranchesThroughCalls) {
  const auto nested = [](const std::string& body, const std::string& more = "") {
    return costOfText(more + "float f(float x) { float y = x;\n" + body + "return y; }\n", "f(i)").nesting;
  };
  EXPECT_EQ(nested(""), 0U);
  EXPECT_EQ(nested("if (x > 1.0) y = 2.0; if (x > 2.0) y = 3.0;"), 1U);
  EXPECT_EQ(nested("if (x > 1.0) { if (x > 2.0) y = 3.0; }"), 2U);
  EXPECT_EQ(nested("if (x > 1.0) y = 2.0; else if (x > 2.0) y = 3.0; else if (x > 3.0) y = 4.0;"), 3U);
  EXPECT_EQ(nested("for (int k = 0; k < 3; ++k) if (x > 2.0) y += 3.0;"), 2U);
  EXPECT_EQ(nested("switch (int(x)) { case 0: y = 2.0; break; case 1: y = 3.0; break; default: y = 4.0; }"),
            1U);
  const std::string g =
      "float g(float x) { float y = x; if (x > 1.0) { if (x > 2.0) y = 3.0; } return y; }\n";
  EXPECT_EQ(nested("y = g(x);", g), 2U);
  EXPECT_EQ(nested("if (x > 1.0) { y = 2.0; } y = g(x);", g), 2U);
  EXPECT_EQ(nested("if (x > 1.0) { if (x < 0.0) y = g(x); }", g), 4U);
  // What follows a branch that leaves.
  EXPECT_EQ(nested("if (x > 1.0) return 2.0; if (x > 2.0) return 3.0; if (x > 3.0) y = 4.0;"), 3U);
  EXPECT_EQ(nested("if (x > 1.0) { if (x > 2.0) return 3.0; } if (x > 3.0) y = 4.0;"), 2U);
  EXPECT_EQ(
      nested("for (int k = 0; k < 3; ++k) { if (x > 1.0) continue; if (x > 2.0) break; if (x > 3.0) y = "
             "4.0; } if (x > 4.0) y = 5.0;"),
      4U);
  EXPECT_EQ(nested("for (int k = 0; k < 3; ++k) { if (x > 1.0) return 2.0; } if (x > 4.0) y = g(x);", g), 4U);
}

/// A call chain that no stack would hold, one frame for each.
TEST(ShaderCost, OfFunctionsInALongRow) {
  constexpr std::uint32_t kFunctions = 1'000'000, kOpEntryPoint = 15, kOpFunction = 54, kOpFunctionEnd = 56,
                          kOpFunctionCall = 57;
  std::vector<std::uint32_t> words(5);
  words.insert(words.end(), {4U << 16 | kOpEntryPoint, 4, 1, 0});
  for (std::uint32_t id = 1; id <= kFunctions; ++id) {
    words.insert(words.end(), {5U << 16 | kOpFunction, 0, id, 0, 0});
    if (id < kFunctions) words.insert(words.end(), {4U << 16 | kOpFunctionCall, 0, 0, id + 1});
    words.insert(words.end(), {1U << 16 | kOpFunctionEnd});
  }
  EXPECT_EQ(costOf(words).instructions, 3U * kFunctions - 1);
}

TEST(ShaderCost, WordsThatAreNoneCostNothing) {
  EXPECT_EQ(costOf({}).instructions, 0U);
  const std::uint32_t words[] = {1, 2, 3, 4, 5, 0x00ff0011, 7};
  EXPECT_EQ(costOf(words).instructions, 0U);
}

}  // namespace
}  // namespace luxo::gpu
