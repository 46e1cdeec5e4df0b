// SPDX-License-Identifier: Apache-2.0
// What a shader reads that its pipeline gives it, beside vertices and push constants: descriptors, and values
// of specialization constants; and where it writes to.
#pragma once

#include "gpu/descriptor.h"
#include "gpu/shader_optimizer.h"
#include "gpu/vk.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace luxo::gpu {

/// A descriptor that is used somewhere in the shader, whether that is run or not. What is only declared is
/// none.
struct StageDescriptor {
  std::uint32_t set = 0, binding = 0;
  /// No shader knows whose offsets are dynamic.
  VkDescriptorType type = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
  std::uint32_t count = 1;  ///< of an array; 0: it does not say
  std::string name;         ///< of its block, if that alone has one; optimised words have none
};

/// One that is declared.
struct StageConstant {
  std::uint32_t id = 0;
  std::string name;
};

struct StageResources {
  std::vector<StageDescriptor> descriptors;
  std::vector<StageConstant> constants;
  std::vector<std::uint32_t> outputs;  ///< locations, ascending; of a fragment shader those of attachments
  bool pushConstants = false;          ///< whether it has some
};

/// Of words as compilers write them for Vulkan 1.3, which keep no function that nobody calls. Cost: one pass,
/// far less than stageInterface().
[[nodiscard]] StageResources stageResources(std::span<const std::uint32_t> spirv);

/// What a pipeline gives one of its stages.
struct GivenResources {
  std::string_view pipeline;  ///< its name
  VkShaderStageFlagBits stage = VK_SHADER_STAGE_VERTEX_BIT;
  std::vector<std::span<const DescriptorBinding>> sets;
  std::span<const SpecializationConstant> constants;
  std::size_t written = 0;  ///< so many attachments, of a fragment shader
};

/// Requires for each descriptor that is asked for one of the same kind, which the stage sees, and for each
/// constant a value, and that each attachment that is written has an output: without a layer that validates,
/// a device reads whatever is there, takes the value that the shader's text happens to have, and writes
/// anything.
void requireAllGiven(const GivenResources& given, const StageResources& asked);

}  // namespace luxo::gpu
