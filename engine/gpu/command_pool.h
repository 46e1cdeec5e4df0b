// SPDX-License-Identifier: Apache-2.0
// One command buffer and the pool it comes from. Used by this folder only.
#pragma once

#include "gpu/handle.h"
#include "gpu/vk.h"

namespace luxo::gpu {

struct CommandPool {
  CommandPool() = default;
  explicit CommandPool(Context& context);

  /// Begins to record anew. No submission in flight may use the buffer.
  void begin();

  Handle<VkCommandPool> pool;
  VkCommandBuffer commands = VK_NULL_HANDLE;
};

}  // namespace luxo::gpu
