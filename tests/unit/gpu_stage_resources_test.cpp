// SPDX-License-Identifier: Apache-2.0
#include "gpu/stage_resources.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "gpu/shader_compiler.h"

namespace luxo::gpu {
namespace {

using testing::UnorderedElementsAre;

constexpr auto kUniform = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, kStorage = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;

std::vector<std::uint32_t> fragmentOf(const std::string& text, bool forReflection) {
  return ShaderCompiler("")
      .compile({.source = {"a.frag", "#version 460\n" + text}, .forReflection = forReflection})
      .spirv;
}

/// Named, as compilers write them.
StageResources resourcesOf(const std::string& text) { return stageResources(fragmentOf(text, true)); }

constexpr const char* kEveryKind = R"(
layout(set = 1, binding = 0) uniform Lights { vec4 light; };
layout(set = 1, binding = 1) buffer Counts { uint counts[]; } named;
layout(set = 0, binding = 2) uniform sampler2D image;
layout(set = 0, binding = 3) uniform usamplerBuffer texels;
layout(set = 0, binding = 4, r32ui) uniform uimage2D drawn;
layout(set = 0, binding = 5, r32ui) uniform uimageBuffer written;
layout(set = 0, binding = 6) uniform texture2D apart;
layout(set = 0, binding = 7) uniform sampler nearest;
layout(set = 2, binding = 8) uniform sampler2D several[6];
layout(location = 0) out vec4 o;
vec4 seen(sampler2D from) { return texture(from, vec2(0)); }
void main() {
  o = light + seen(image) + texelFetch(texels, 0) + texture(sampler2D(apart, nearest), vec2(0)) +
      texture(several[5], vec2(0));
  imageAtomicAdd(drawn, ivec2(0), named.counts.length());
  imageStore(written, 0, uvec4(1));
})";

std::vector<std::string> tableOf(const StageResources& resources) {
  std::vector<std::string> lines;
  for (const StageDescriptor& d : resources.descriptors)
    lines.push_back(fmt::format("{}.{} {} x{}", d.set, d.binding, static_cast<int>(d.type), d.count));
  return lines;
}

TEST(StageResources, AreOfEveryKind) {
  const std::vector<std::string> expected{
      fmt::format("1.0 {} x1", static_cast<int>(kUniform)),
      fmt::format("1.1 {} x1", static_cast<int>(kStorage)),
      fmt::format("0.2 {} x1", static_cast<int>(VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER)),
      fmt::format("0.3 {} x1", static_cast<int>(VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER)),
      fmt::format("0.4 {} x1", static_cast<int>(VK_DESCRIPTOR_TYPE_STORAGE_IMAGE)),
      fmt::format("0.5 {} x1", static_cast<int>(VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER)),
      fmt::format("0.6 {} x1", static_cast<int>(VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE)),
      fmt::format("0.7 {} x1", static_cast<int>(VK_DESCRIPTOR_TYPE_SAMPLER)),
      fmt::format("2.8 {} x6", static_cast<int>(VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER))};
  const StageResources named = resourcesOf(kEveryKind);
  EXPECT_THAT(tableOf(named), testing::UnorderedElementsAreArray(expected));
  EXPECT_THAT(tableOf(stageResources(fragmentOf(kEveryKind, false))),
              testing::UnorderedElementsAreArray(expected))
      << "optimised they are the same";
  std::vector<std::string> names;
  for (const StageDescriptor& descriptor : named.descriptors) names.push_back(descriptor.name);
  EXPECT_THAT(names, UnorderedElementsAre("Lights", "named", "image", "texels", "drawn", "written", "apart",
                                          "nearest", "several"));
}

// The optimiser keeps what is declared, too.
TEST(StageResources, WhatIsOnlyDeclaredIsNoneOfThem) {
  const char* const text = R"(
layout(constant_id = 4) const bool kUses = false;
layout(set = 0, binding = 0) uniform View { vec4 view; };
layout(set = 0, binding = 1) buffer Doubts { uint doubts[]; };
layout(set = 0, binding = 2) uniform sampler2D image;
layout(location = 0) out vec4 o;
void main() { o = kUses ? texture(image, vec2(0)) : vec4(view); })";
  for (const bool forReflection : {true, false}) {
    std::vector<std::uint32_t> bindings;
    for (const StageDescriptor& descriptor : stageResources(fragmentOf(text, forReflection)).descriptors)
      bindings.push_back(descriptor.binding);
    EXPECT_THAT(bindings, UnorderedElementsAre(0u, 2u)) << "the value of the constant is not asked for";
  }
}

TEST(StageResources, TellConstantsAndWhetherAnyArePushed) {
  const std::string rest = "layout(location = 0) out vec4 o;\n";
  const StageResources some = resourcesOf(
      "layout(constant_id = 7) const uint kCount = 2;\n"
      "layout(constant_id = 3) const float kWidth = 0.5;\n" +
      rest + "void main() { o = vec4(kCount * kWidth); }\n");
  std::vector<std::string> constants;
  for (const StageConstant& constant : some.constants)
    constants.push_back(fmt::format("{} {}", constant.id, constant.name));
  EXPECT_THAT(constants, UnorderedElementsAre("7 kCount", "3 kWidth"));
  EXPECT_FALSE(some.pushConstants);
  const StageResources pushed = resourcesOf("layout(push_constant) uniform Push { vec4 tint; };\n" + rest +
                                            "void main() { o = tint; }\n");
  EXPECT_TRUE(pushed.pushConstants);
  EXPECT_TRUE(pushed.constants.empty() && pushed.descriptors.empty());
}

TEST(StageResources, OfNothingAreNone) {
  const StageResources none = stageResources({});
  EXPECT_TRUE(none.descriptors.empty() && none.constants.empty() && !none.pushConstants);
}

TEST(StageResourcesDeathTest, DescriptorsMustBeThereAndOfTheSameKindAndSeen) {
  const auto asks = [](const DescriptorBinding& only, const StageDescriptor& descriptor) {
    requireAllGiven({"given", VK_SHADER_STAGE_FRAGMENT_BIT, {{}, {&only, 1}}, {}}, {{descriptor}, {}});
  };
  asks({kUniform}, {1, 0, kUniform, 1, "Lights"});
  asks({VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC}, {1, 0, kUniform, 1, "Lights"});
  asks({kStorage, VK_SHADER_STAGE_FRAGMENT_BIT}, {1, 0, kStorage, 0, "Several"});
  EXPECT_DEATH(asks({kUniform}, {1, 1, kUniform, 1, "Lights"}),
               "set 1, binding 1 in the fragment shader of \"given\": nothing versus "
               "set 1, binding 1 in the fragment shader of \"given\": uniform buffer Lights");
  EXPECT_DEATH(asks({kUniform}, {0, 0, kUniform, 1, "Lights"}), "nothing versus .* uniform buffer Lights");
  EXPECT_DEATH(asks({kUniform}, {2, 0, kUniform, 1, "Lights"}), "nothing versus .* uniform buffer Lights");
  EXPECT_DEATH(asks({kStorage}, {1, 0, kUniform, 1, "Lights"}),
               "storage buffer versus .* uniform buffer Lights");
  EXPECT_DEATH(asks({VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER},
                    {1, 0, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, 1, "texels"}),
               "combined image sampler versus .* uniform texel buffer texels");
  EXPECT_DEATH(asks({kStorage, VK_SHADER_STAGE_VERTEX_BIT}, {1, 0, kStorage, 1, "Doubts"}),
               "storage buffer of other stages versus .* storage buffer Doubts");
  EXPECT_DEATH(asks({kStorage}, {1, 0, kStorage, 3, "Several"}),
               "storage buffer versus .* storage buffer.3. Several");
}

TEST(StageResources, WriteToLocations) {
  const StageResources two = resourcesOf(R"(
layout(location = 2) out vec2 second[3];
layout(location = 0) out uvec4 first;
void main() {
  second[1] = vec2(1);
  first = uvec4(2);
  gl_FragDepth = 0.5;
})");
  EXPECT_EQ(two.outputs, (std::vector<std::uint32_t>{0, 2, 3, 4}));
}

TEST(StageResourcesDeathTest, AttachmentsMustBeWrittenTo) {
  const StageResources one =
      resourcesOf("layout(location = 0) out vec4 first; void main() { first = vec4(1); }");
  GivenResources given{.pipeline = "p", .stage = VK_SHADER_STAGE_FRAGMENT_BIT, .written = 1};
  requireAllGiven(given, one);
  given.written = 2;
  EXPECT_DEATH(requireAllGiven(given, one), "attachment 1 of the fragment shader of \"p\"");
}

TEST(StageResourcesDeathTest, ConstantsMustHaveValues) {
  const auto asks = [](const StageConstant& constant) {
    const std::array<SpecializationConstant, 2> values{{{0, 1}, {5, 2}}};
    requireAllGiven({"given", VK_SHADER_STAGE_VERTEX_BIT, {}, values}, {{}, {constant}});
  };
  asks({5, "kCount"});
  EXPECT_DEATH(asks({1, "kWidth"}), "constant 1 in the vertex shader of \"given\": nothing versus .* kWidth");
}

}  // namespace
}  // namespace luxo::gpu
