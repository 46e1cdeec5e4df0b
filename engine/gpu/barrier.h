// SPDX-License-Identifier: Apache-2.0
// Records the barriers that the coming uses of buffers and textures need.
#pragma once

#include "gpu/buffer.h"
#include "gpu/texture.h"
#include "gpu/usage.h"
#include "gpu/vk.h"

#include <initializer_list>
#include <span>

namespace luxo::gpu {

/// One resource and how it is used next.
struct Usage {
  Usage(Texture& texture, Use use, Contents contents = Contents::Keep);
  Usage(Buffer& buffer, Use use);
  /// A colour image that is not ours, such as one of a swapchain.
  Usage(VkImage image, ResourceState& state, Use use, Contents contents = Contents::Keep);

  VkImage image = VK_NULL_HANDLE;
  VkImageAspectFlags aspect = VK_IMAGE_ASPECT_NONE;
  VkBuffer buffer = VK_NULL_HANDLE;
  ResourceState* state = nullptr;
  Use use;
  Contents contents = Contents::Keep;
};

/// Records one vkCmdPipelineBarrier2 that makes all usages safe, or nothing when they are. Name each resource
/// once, outside of rendering, right before the commands that use it:
///     use(commands, {{color, Use::ColorAttachment, Contents::Discard}, {depth, Use::DepthAttachment}});
void use(VkCommandBuffer commands, std::span<const Usage> usages);
inline void use(VkCommandBuffer commands, std::initializer_list<Usage> usages) {
  use(commands, std::span(usages.begin(), usages.size()));
}

}  // namespace luxo::gpu
