// SPDX-License-Identifier: Apache-2.0
#include "gpu/timeline.h"

#include "base/assert.h"
#include "gpu/result.h"

#include <limits>
#include <vector>

namespace luxo::gpu {

Timeline::Timeline(VkDevice device, VkQueue queue) : device_(device), queue_(queue) {
  const VkSemaphoreTypeCreateInfo type{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO,
                                       .semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE};
  const VkSemaphoreCreateInfo info{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO, .pNext = &type};
  check(vkCreateSemaphore(device_, &info, nullptr, &semaphore_), "create the timeline semaphore");
}

Timeline::~Timeline() { vkDestroySemaphore(device_, semaphore_, nullptr); }

std::uint64_t Timeline::submit(std::span<const VkCommandBuffer> commands,
                               std::span<const SemaphoreWait> waits, std::span<const VkSemaphore> signals) {
  std::vector<VkCommandBufferSubmitInfo> commandInfos;
  for (const VkCommandBuffer buffer : commands) {
    commandInfos.push_back({.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO, .commandBuffer = buffer});
  }
  std::vector<VkSemaphoreSubmitInfo> waitInfos;
  for (const SemaphoreWait& wait : waits) {
    waitInfos.push_back({.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
                         .semaphore = wait.semaphore,
                         .stageMask = wait.stage});
  }
  std::vector<VkSemaphoreSubmitInfo> signalInfos{{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
                                                  .semaphore = semaphore_,
                                                  .value = submitted_ + 1,
                                                  .stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT}};
  for (const VkSemaphore signal : signals) {
    signalInfos.push_back({.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
                           .semaphore = signal,
                           .stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT});
  }
  const VkSubmitInfo2 info{.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
                           .waitSemaphoreInfoCount = static_cast<std::uint32_t>(waitInfos.size()),
                           .pWaitSemaphoreInfos = waitInfos.data(),
                           .commandBufferInfoCount = static_cast<std::uint32_t>(commandInfos.size()),
                           .pCommandBufferInfos = commandInfos.data(),
                           .signalSemaphoreInfoCount = static_cast<std::uint32_t>(signalInfos.size()),
                           .pSignalSemaphoreInfos = signalInfos.data()};
  check(vkQueueSubmit2(queue_, 1, &info, VK_NULL_HANDLE), "submit commands to the device");
  destruction_.submitted(++submitted_);
  return submitted_;
}

std::uint64_t Timeline::completed() {
  if (completed_ < submitted_) {
    check(vkGetSemaphoreCounterValue(device_, semaphore_, &completed_), "ask the device how far it is");
  }
  return completed_;
}

void Timeline::wait(std::uint64_t number) {
  LUXO_REQUIRE_COMPARE(number, <=, submitted_);
  if (number <= completed_) return;
  const VkSemaphoreWaitInfo info{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO,
                                 .semaphoreCount = 1,
                                 .pSemaphores = &semaphore_,
                                 .pValues = &number};
  check(vkWaitSemaphores(device_, &info, std::numeric_limits<std::uint64_t>::max()), "wait for the device");
  completed_ = number;
}

}  // namespace luxo::gpu
