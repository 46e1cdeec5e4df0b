// SPDX-License-Identifier: Apache-2.0
#include "gpu/command_pool.h"

#include "gpu/result.h"

namespace luxo::gpu {

CommandPool::CommandPool(Context& context) {
  const VkCommandPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                     .flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT,
                                     .queueFamilyIndex = context.queueFamily()};
  VkCommandPool raw = VK_NULL_HANDLE;
  check(vkCreateCommandPool(context.device(), &info, nullptr, &raw), "create a command pool");
  pool = {context, raw};
  const VkCommandBufferAllocateInfo allocate{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                             .commandPool = raw,
                                             .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                             .commandBufferCount = 1};
  check(vkAllocateCommandBuffers(context.device(), &allocate, &commands), "allocate a command buffer");
}

void CommandPool::begin() {
  check(vkResetCommandPool(pool.context()->device(), pool, 0), "reset a command pool");
  const VkCommandBufferBeginInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                      .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
  check(vkBeginCommandBuffer(commands, &info), "begin to record commands");
}

}  // namespace luxo::gpu
