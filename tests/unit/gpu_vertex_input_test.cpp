// SPDX-License-Identifier: Apache-2.0
#include "gpu/vertex_input.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace luxo::gpu {
namespace {

/// Each attribute has a binding of its own.
GraphicsPipelineDesc given(const std::vector<VkFormat>& formats) {
  GraphicsPipelineDesc desc{.name = "given"};
  for (std::uint32_t i = 0; i < formats.size(); ++i) {
    desc.bindings.push_back({.binding = i, .stride = 16});
    desc.attributes.push_back({.location = i, .binding = i, .format = formats[i]});
  }
  return desc;
}

TEST(VertexInput, IsWhatTheShaderReads) {
  const GraphicsPipelineDesc desc =
      given({VK_FORMAT_R32G32B32_SFLOAT, VK_FORMAT_R32G32_SFLOAT, VK_FORMAT_R32G32B32A32_UINT});
  const VertexInput input(desc, std::vector<StageInput>{{0, "vec3", "inPosition"}, {2, "uvec4", "inRange"}});
  ASSERT_TRUE(input.attributes.size() == 2 && input.bindings.size() == 2);
  EXPECT_TRUE(input.attributes[0].location == 0 && input.attributes[1].location == 2);
  EXPECT_TRUE(input.bindings[0].binding == 0 && input.bindings[1].binding == 2);
}

TEST(VertexInput, OfNothingIsEmpty) {
  const VertexInput input(given({VK_FORMAT_R32_UINT}), {});
  EXPECT_TRUE(input.attributes.empty() && input.bindings.empty());
}

TEST(VertexInputDeathTest, MustBeThereAndOfTheSameType) {
  const auto asks = [](VkFormat format, const StageInput& input) {
    static_cast<void>(VertexInput(given({format}), {&input, 1}));
  };
  asks(VK_FORMAT_R32G32B32_SFLOAT, {0, "vec3", "inNormal"});
  EXPECT_DEATH(asks(VK_FORMAT_R32G32B32_SFLOAT, {1, "vec3", "inNormal"}),
               "location 1 of \"given\": nothing versus location 1 of \"given\": vec3 inNormal");
  // Fewer components, more, and others.
  EXPECT_DEATH(asks(VK_FORMAT_R32G32_SFLOAT, {0, "vec3", "inNormal"}), "vec2 versus .* vec3 inNormal");
  EXPECT_DEATH(asks(VK_FORMAT_R32G32B32A32_SFLOAT, {0, "vec3", "inNormal"}), "vec4 versus .* vec3 inNormal");
  EXPECT_DEATH(asks(VK_FORMAT_R32G32B32_UINT, {0, "vec3", "inNormal"}), "uvec3 versus .* vec3 inNormal");
  EXPECT_DEATH(asks(VK_FORMAT_R32_SINT, {0, "uint", "inFlags"}), "int versus .* uint inFlags");
  EXPECT_DEATH(asks(VK_FORMAT_R8G8B8A8_UNORM, {0, "vec4", "inColor"}), "no vertices have .* vec4 inColor");
}

}  // namespace
}  // namespace luxo::gpu
