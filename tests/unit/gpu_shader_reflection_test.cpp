// SPDX-License-Identifier: Apache-2.0
// What reflection says of layouts, against tables that were worked out by hand from the rules of GLSL.
#include "gpu/shader_reflection.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "base/error.h"
#include "gpu/shader_validation.h"

namespace luxo::gpu {
namespace {

using testing::ElementsAre;

ShaderInterface reflected(const std::string& text, ShaderStage stage = ShaderStage::Fragment) {
  return reflect(
      ShaderCompiler("").compile({.source = {"a.glsl", text}, .stage = stage, .forReflection = true}).spirv);
}

/// "b vec3 @16 +12", with strides where there are some.
std::vector<std::string> tableOf(const ShaderBlock& block) {
  std::vector<std::string> lines;
  for (const ShaderVariable& m : block.members) {
    lines.push_back(fmt::format("{} {} @{} +{}", m.name, m.type, m.offset, m.size));
    for (const std::uint32_t size : m.array) lines.back() += fmt::format(" [{}]", size);
    if (m.arrayStride > 0) lines.back() += fmt::format(" stride {}", m.arrayStride);
    if (m.matrixStride > 0)
      lines.back() += fmt::format(" {} {}", m.rowMajor ? "rows" : "columns", m.matrixStride);
  }
  return lines;
}

ShaderBlock blockOf(const std::string& layout, const std::string& kind) {
  return reflected(fmt::format("#version 460\n#extension GL_EXT_scalar_block_layout : require\n"
                               "layout({}, set = 1, binding = 2) {} B {{ float a; vec3 b; float c; mat3 m; "
                               "float d[3]; vec2 e; }} k;\n"
                               "layout(location = 0) out vec4 o;\n"
                               "void main() {{ o = vec4(k.b, k.d[1] + k.m[0].x); }}\n",
                               layout, kind))
      .blocks.at(0);
}

TEST(ShaderReflection, Std140) {
  const ShaderBlock block = blockOf("std140", "uniform");
  EXPECT_THAT(tableOf(block),
              ElementsAre("a float @0 +4", "b vec3 @16 +12", "c float @28 +4", "m mat3 @32 +48 columns 16",
                          "d float @80 +48 [3] stride 16", "e vec2 @128 +8"));
  EXPECT_EQ(block.size, 136u);
  EXPECT_TRUE(block.set == 1 && block.binding == 2 && block.kind == ShaderBlock::Kind::Uniform &&
              !block.loose);
  EXPECT_TRUE(block.members[1].active && block.members[3].active);
  EXPECT_FALSE(block.members[0].active || block.members[5].active);
}

TEST(ShaderReflection, Std430) {
  const ShaderBlock block = blockOf("std430", "buffer");
  EXPECT_THAT(tableOf(block),
              ElementsAre("a float @0 +4", "b vec3 @16 +12", "c float @28 +4", "m mat3 @32 +48 columns 16",
                          "d float @80 +12 [3] stride 4", "e vec2 @96 +8"));
  EXPECT_EQ(block.kind, ShaderBlock::Kind::Storage);
}

TEST(ShaderReflection, Scalar) {
  const ShaderBlock block = blockOf("scalar", "uniform");
  EXPECT_THAT(tableOf(block),
              ElementsAre("a float @0 +4", "b vec3 @4 +12", "c float @16 +4", "m mat3 @20 +36 columns 12",
                          "d float @56 +12 [3] stride 4", "e vec2 @68 +8"));
}

/// Of m columns and n rows, row major: n vectors of m.
ShaderBlock rowMajorBlock(const std::string& layout, const std::string& kind) {
  return reflected(
             fmt::format("#version 460\n#extension GL_EXT_scalar_block_layout : require\n"
                         "layout({}, row_major, set = 0, binding = 0) {} B {{ mat3 a; mat2x3 b; mat3x2 c; "
                         "float d; layout(column_major) mat2x3 e; mat2 f[2]; }} k;\n"
                         "layout(location = 0) out vec4 o;\n"
                         "void main() {{ o = vec4(k.a[1], k.d); }}\n",
                         layout, kind))
      .blocks.at(0);
}

TEST(ShaderReflection, RowMajorMatrices) {
  const ShaderBlock std140 = rowMajorBlock("std140", "uniform"), std430 = rowMajorBlock("std430", "buffer"),
                    scalar = rowMajorBlock("scalar", "buffer");
  EXPECT_THAT(tableOf(std140),
              ElementsAre("a mat3 @0 +48 rows 16", "b mat2x3 @48 +48 rows 16", "c mat3x2 @96 +32 rows 16",
                          "d float @128 +4", "e mat2x3 @144 +32 columns 16",
                          "f mat2 @176 +64 [2] stride 32 rows 16"));
  EXPECT_EQ(std140.size, 240u);
  EXPECT_THAT(
      tableOf(std430),
      ElementsAre("a mat3 @0 +48 rows 16", "b mat2x3 @48 +24 rows 8", "c mat3x2 @80 +32 rows 16",
                  "d float @112 +4", "e mat2x3 @128 +32 columns 16", "f mat2 @160 +32 [2] stride 16 rows 8"));
  EXPECT_EQ(std430.size, 192u);
  EXPECT_THAT(
      tableOf(scalar),
      ElementsAre("a mat3 @0 +36 rows 12", "b mat2x3 @36 +24 rows 8", "c mat3x2 @60 +24 rows 12",
                  "d float @84 +4", "e mat2x3 @88 +24 columns 12", "f mat2 @112 +32 [2] stride 16 rows 8"));
  EXPECT_EQ(scalar.size, 144u);
}

/// An array at the end of a buffer that is as long as this is: its size is not known, its stride is.
TEST(ShaderReflection, RuntimeSizedArrays) {
  const auto blockOfItems = [](const std::string& layout, const std::string& items) {
    return reflected(
               fmt::format("#version 460\n#extension GL_EXT_scalar_block_layout : require\n"
                           "struct S {{ vec3 p; float w; mat2 m; }};\n"
                           "layout({}, set = 0, binding = 0) buffer B {{ uint count; {} items[]; }} k;\n"
                           "layout(location = 0) out vec4 o;\nvoid main() {{ o = vec4(k.count); }}\n",
                           layout, items))
        .blocks.at(0);
  };
  EXPECT_THAT(tableOf(blockOfItems("std430", "vec3")),
              ElementsAre("count uint @0 +4", "items vec3 @16 +0 [0] stride 16"));
  EXPECT_THAT(tableOf(blockOfItems("scalar", "vec3")),
              ElementsAre("count uint @0 +4", "items vec3 @4 +0 [0] stride 12"));
  EXPECT_THAT(tableOf(blockOfItems("std140", "float")),
              ElementsAre("count uint @0 +4", "items float @16 +0 [0] stride 16"));
  const auto structured = [&](const std::string& layout) { return blockOfItems(layout, "S"); };
  const ShaderBlock std430 = structured("std430");
  EXPECT_THAT(tableOf(std430), ElementsAre("count uint @0 +4", "items S @16 +0 [0] stride 32"));
  EXPECT_EQ(std430.members[1].members.at(2).offset, 16u);
  EXPECT_EQ(std430.members[1].members.at(2).matrixStride, 8u);
  EXPECT_THAT(tableOf(structured("std140")), ElementsAre("count uint @0 +4", "items S @16 +0 [0] stride 48"));
  EXPECT_THAT(tableOf(structured("scalar")), ElementsAre("count uint @0 +4", "items S @4 +0 [0] stride 32"));
}

/// What a stage takes and gives, in the words of its layouts; of what is there for each vertex an array.
TEST(ShaderReflection, StagesBetweenVerticesAndFragments) {
  const ShaderInterface geometry = reflected(R"(#version 460
layout(triangles, invocations = 2) in;
layout(line_strip, max_vertices = 6) out;
in vec3 normal[];
out vec4 color;
uniform mat4 matrix;
void main() {
  color = vec4(normal[1], 1.0);
  gl_Position = matrix * gl_in[0].gl_Position;
  gl_Layer = gl_InvocationID;
  EmitVertex();
})",
                                             ShaderStage::Geometry);
  EXPECT_EQ(geometry.stage, ShaderStage::Geometry);
  EXPECT_THAT(geometry.layout, ElementsAre("triangles", "line_strip", "max_vertices = 6", "invocations = 2"));
  ASSERT_FALSE(geometry.inputs.empty());
  EXPECT_EQ(geometry.inputs[0].name, "normal");
  EXPECT_THAT(geometry.inputs[0].array, ElementsAre(3u));
  const auto namesOf = [](const std::vector<ShaderVariable>& variables) {
    std::vector<std::string> names;
    for (const ShaderVariable& one : variables) names.push_back(one.name);
    return names;
  };
  EXPECT_THAT(namesOf(geometry.inputs), testing::Contains("gl_InvocationID"));
  EXPECT_THAT(namesOf(geometry.outputs), testing::IsSupersetOf({"color", "gl_Position", "gl_Layer"}));

  const ShaderInterface control = reflected(R"(#version 460
layout(vertices = 3) out;
in vec2 uv[];
out vec2 uvOut[];
patch out float sharpness;
void main() {
  uvOut[gl_InvocationID] = uv[gl_InvocationID];
  sharpness = 1.0;
  gl_TessLevelInner[0] = 2.0;
  gl_TessLevelOuter[0] = 3.0;
})",
                                            ShaderStage::TessellationControl);
  EXPECT_THAT(control.layout, ElementsAre("vertices = 3"));
  for (const ShaderVariable& output : control.outputs) EXPECT_EQ(output.patch, output.name == "sharpness");
  EXPECT_THAT(namesOf(control.outputs), testing::IsSupersetOf({"uvOut", "sharpness", "gl_TessLevelOuter"}));

  const ShaderInterface evaluation = reflected(R"(#version 460
layout(quads, fractional_odd_spacing, cw) in;
patch in float sharpness;
void main() { gl_Position = vec4(gl_TessCoord * sharpness, 1.0); })",
                                               ShaderStage::TessellationEvaluation);
  EXPECT_THAT(evaluation.layout, ElementsAre("quads", "fractional_odd_spacing", "cw"));
  EXPECT_TRUE(evaluation.inputs.at(0).patch);

  EXPECT_THAT(reflected("#version 460\nlayout(local_size_x = 8, local_size_y = 4) in;\nvoid main() { }\n",
                        ShaderStage::Compute)
                  .layout,
              ElementsAre("local_size_x = 8", "local_size_y = 4", "local_size_z = 1"));
}

/// Each function calls the one before twice: whoever follows all calls has no end.
TEST(ShaderReflection, FunctionsThatDoubleAreRefused) {
  std::string text =
      "#version 460\nlayout(location = 0) out float o;\nfloat f0(float x) { return sin(x); }\n";
  for (int i = 1; i <= 40; ++i)
    text += fmt::format("float f{}(float x) {{ return f{}(x) + f{}(2.0 * x); }}\n", i, i - 1, i - 1);
  text += "void main() { o = f40(gl_FragCoord.x); }\n";
  try {
    static_cast<void>(reflected(text));
    ADD_FAILURE() << "it was read";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::Scene);
    EXPECT_THAT(error.what(), testing::HasSubstr("with a copy of each function at each of its calls"));
  }
}

/// The uniforms of a lecture's vertex program, outside of blocks.
TEST(ShaderReflection, UniformsOutsideOfBlocksAndAttributes) {
  const ShaderInterface all = reflected(R"(#version 330
uniform mat4 MVP, M, Minv;
uniform vec4 wLiPos;
uniform vec3 wEye;
layout(location = 0) in vec3 vtxPos;
layout(location = 1) in vec3 vtxNorm;
out vec3 wNormal, wView, wLight;
void main() {
  gl_Position = vec4(vtxPos, 1) * MVP;
  vec4 wPos = vec4(vtxPos, 1) * M;
  wLight = wLiPos.xyz * wPos.w - wPos.xyz * wLiPos.w;
  wView = wEye * wPos.w - wPos.xyz;
  wNormal = (Minv * vec4(vtxNorm, 0)).xyz;
})",
                                        ShaderStage::Vertex);
  EXPECT_EQ(all.stage, ShaderStage::Vertex);
  ASSERT_EQ(all.blocks.size(), 1u);
  EXPECT_TRUE(all.blocks[0].loose);
  EXPECT_EQ(all.blocks[0].size, 220u);
  EXPECT_THAT(tableOf(all.blocks[0]),
              ElementsAre("MVP mat4 @0 +64 columns 16", "M mat4 @64 +64 columns 16",
                          "Minv mat4 @128 +64 columns 16", "wLiPos vec4 @192 +16", "wEye vec3 @208 +12"));
  ASSERT_EQ(all.inputs.size(), 2u);
  EXPECT_TRUE(all.inputs[0].name == "vtxPos" && all.inputs[1].location == 1u);
  EXPECT_EQ(all.outputs.size(), 4u);  // gl_Position, too
}

TEST(ShaderReflection, APipelineIsToldInputsAndPushConstants) {
  const auto stage = stageInterface(ShaderCompiler("")
                                        .compile({.source = {"a.vert", R"(#version 460
layout(location = 4) in vec3 inNormal;
layout(location = 0) in vec2 inPlace;
layout(location = 1) in mat3 inFrame;
layout(location = 5) in uvec4 inCounts[2];
layout(push_constant) uniform Draw { mat4 clip; vec3 eye; float side; vec2 size; };
void main() {
  gl_Position = clip * vec4(inFrame * (inNormal + side * eye) + vec3(inPlace * size, gl_VertexIndex), 1) +
                vec4(inCounts[0] + inCounts[1]);
})"},
                                                  .stage = ShaderStage::Vertex})
                                        .spirv);
  std::vector<std::string> inputs;
  for (const StageInput& input : stage.inputs)
    inputs.push_back(fmt::format("{} {}", input.location, input.type));
  EXPECT_THAT(inputs, ElementsAre("0 vec2", "1 vec3", "2 vec3", "3 vec3", "4 vec3", "5 uvec4", "6 uvec4"));
  EXPECT_EQ(stage.pushConstantBytes, 64u + 16 + 8);
}

TEST(ShaderReflection, TellsWhatIsBeyondPlainGlsl) {
  const auto beyond = [](const std::string& extension, const std::string& value) {
    return reflected("#version 460\n" + extension +
                     "\nlayout(location = 0) out vec4 o;\nvoid main() { o = vec4(" + value + "); }\n")
        .beyond;
  };
  EXPECT_EQ(beyond("", "double(gl_FragCoord.x)"), "");
  EXPECT_EQ(beyond("uniform sampler1D s;", "texture(s, 0.5).x + fwidthFine(gl_FragCoord.x)"), "");
  EXPECT_EQ(beyond("", "gl_SampleID"), "samples one by one");
  EXPECT_EQ(beyond("#extension GL_KHR_shader_subgroup_basic : require", "subgroupElect() ? 1.0 : 0.0"),
            "subgroups");
  EXPECT_EQ(beyond("#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require",
                   "float(int64_t(gl_FragCoord.x))"),
            "64-bit integers");
  EXPECT_EQ(beyond("layout(early_fragment_tests) in;", "1.0"), "early_fragment_tests");
}

TEST(ShaderReflection, NamesWhatTheLanguageHands) {
  const ShaderInterface all = reflected(
      "#version 460\nlayout(location = 0) out vec4 o;\nvoid main() { o = vec4(gl_PointCoord, gl_FrontFacing, "
      "gl_HelperInvocation); }\n");
  std::vector<std::string> names;
  for (const ShaderVariable& input : all.inputs) names.push_back(input.type + " " + input.name);
  EXPECT_THAT(names, testing::UnorderedElementsAre("vec2 gl_PointCoord", "bool gl_FrontFacing",
                                                   "bool gl_HelperInvocation"));
}

/// Each word of a good one in turn is another one: valid by chance, or refused.
TEST(ShaderValidation, DamagedWordsAreRefusedOrRead) {
  const std::vector<std::uint32_t> good =
      ShaderCompiler("")
          .compile(
              {.source = {"a.frag",
                          "#version 460\nlayout(location = 0) out vec4 o;\nuniform float a[3];\n"
                          "float f(float x) { return a[int(x)]; }\nvoid main() { o = vec4(f(a[1])); }\n"},
               .forReflection = true})
          .spirv;
  EXPECT_NO_THROW(requireValid(good));
  EXPECT_THROW(requireValid({}), Error);
  int refused = 0;
  for (std::size_t i = 0; i < good.size(); ++i)
    for (const std::uint32_t other : {0U, 1U, 0xffffffffU, good[i] ^ 0x10000U}) {
      std::vector<std::uint32_t> damaged = good;
      damaged[i] = other;
      try {
        requireValid(damaged);
        static_cast<void>(reflect(damaged));
      } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::Scene);
        ++refused;
      }
    }
  EXPECT_GT(refused, 2 * static_cast<int>(good.size()));
}

TEST(ShaderReflection, ABufferThatPointsToItself) {
  const ShaderInterface all = reflected(
      "#version 460\n#extension GL_EXT_buffer_reference : require\n"
      "layout(buffer_reference) buffer B;\nlayout(buffer_reference) buffer B { B next; float x; };\n"
      "layout(push_constant) uniform P { B first; float y; };\nlayout(location = 0) out vec4 o;\n"
      "void main() { o = vec4(first.next.x + y); }\n");
  ASSERT_EQ(all.blocks.size(), 1u);
  ASSERT_EQ(all.blocks[0].members.size(), 2u);
  EXPECT_THAT(all.blocks[0].members[0].members, testing::IsEmpty());
  EXPECT_EQ(all.blocks[0].members[1].offset, 8u);
}

TEST(ShaderReflection, WhatIsNoSpirvIsRefused) {
  EXPECT_THROW(static_cast<void>(reflect({})), Error);
  EXPECT_THROW(static_cast<void>(stageInterface({})), Error);
  EXPECT_THROW(static_cast<void>(reflect(std::array<std::uint32_t, 8>{1, 2, 3})), Error);
}

}  // namespace
}  // namespace luxo::gpu
