// SPDX-License-Identifier: Apache-2.0
// What of a pipeline's vertices its shader reads.
#pragma once

#include "gpu/pipeline.h"
#include "gpu/shader_reflection.h"
#include "gpu/vk.h"

#include <span>
#include <vector>

namespace luxo::gpu {

/// The attributes that a vertex shader reads, and the bindings that they come from.
struct VertexInput {
  std::vector<VkVertexInputAttributeDescription> attributes;
  std::vector<VkVertexInputBindingDescription> bindings;

  /// Requires for all that is asked for an attribute of the same kind of numbers, and as many: a device makes
  /// up what is missing, and takes the bits of one kind for those of another.
  VertexInput(const GraphicsPipelineDesc& desc, std::span<const StageInput> asked);
};

}  // namespace luxo::gpu
