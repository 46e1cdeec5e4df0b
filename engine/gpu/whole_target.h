// SPDX-License-Identifier: Apache-2.0
// What a shader computes, as numbers: it runs once for every texel of targets of its own, which are read
// back.
#pragma once

#include <functional>
#include <vector>

#include "gpu/frame.h"
#include "gpu/pipeline.h"
#include "gpu/transfer.h"

namespace luxo::gpu {

/// Draws the triangle of three vertices that the pipeline's vertex shader makes, which covers them all, into
/// `count` targets of `format`, and waits. `bind`: of the descriptor sets that the pipeline reads. Cost:
/// targets and buffers made and freed.
[[nodiscard]] std::vector<Readback> drawWholeTargets(
    Context& context, const GraphicsPipeline& pipeline, VkExtent2D extent, VkFormat format,
    std::size_t count = 1, const std::function<void(FrameRing& frames, VkCommandBuffer commands)>& bind = {});

}  // namespace luxo::gpu
