// SPDX-License-Identifier: Apache-2.0
#include "gpu/vertex_input.h"

#include "base/assert.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>

namespace luxo::gpu {
namespace {

/// As GLSL writes what a shader gets of it.
std::string_view glslTypeOf(VkFormat format) {
  switch (format) {
    case VK_FORMAT_R32_SFLOAT:
      return "float";
    case VK_FORMAT_R32G32_SFLOAT:
      return "vec2";
    case VK_FORMAT_R32G32B32_SFLOAT:
      return "vec3";
    case VK_FORMAT_R32G32B32A32_SFLOAT:
      return "vec4";
    case VK_FORMAT_R32_SINT:
      return "int";
    case VK_FORMAT_R32G32_SINT:
      return "ivec2";
    case VK_FORMAT_R32G32B32_SINT:
      return "ivec3";
    case VK_FORMAT_R32G32B32A32_SINT:
      return "ivec4";
    case VK_FORMAT_R32_UINT:
      return "uint";
    case VK_FORMAT_R32G32_UINT:
      return "uvec2";
    case VK_FORMAT_R32G32B32_UINT:
      return "uvec3";
    case VK_FORMAT_R32G32B32A32_UINT:
      return "uvec4";
    default:
      return "a format that no vertices have yet";
  }
}

void requireGiven(const GraphicsPipelineDesc& desc, const StageInput& input) {
  const auto attribute =
      std::ranges::find(desc.attributes, input.location, &VkVertexInputAttributeDescription::location);
  const std::string_view type =
      attribute == desc.attributes.end() ? "nothing" : glslTypeOf(attribute->format);
  if (type == input.type) return;
  const std::string where = fmt::format("location {} of \"{}\"", input.location, desc.name);
  const std::string given = fmt::format("{}: {}", where, type);
  const std::string asked = fmt::format("{}: {} {}", where, input.type, input.name);
  LUXO_REQUIRE_COMPARE(given, ==, asked);
}

}  // namespace

VertexInput::VertexInput(const GraphicsPipelineDesc& desc, std::span<const StageInput> asked)
    : attributes(desc.attributes), bindings(desc.bindings) {
  for (const StageInput& input : asked) requireGiven(desc, input);
  std::erase_if(attributes, [&](const VkVertexInputAttributeDescription& attribute) {
    return !std::ranges::binary_search(asked, attribute.location, {}, &StageInput::location);
  });
  std::erase_if(bindings, [&](const VkVertexInputBindingDescription& binding) {
    return std::ranges::none_of(attributes,
                                [&](const auto& attribute) { return attribute.binding == binding.binding; });
  });
}

}  // namespace luxo::gpu
