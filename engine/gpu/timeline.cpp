// SPDX-License-Identifier: Apache-2.0
#include "gpu/timeline.h"

#include "base/assert.h"
#include "base/error.h"
#include "gpu/result.h"

#include <ctime>
#include <vector>

namespace luxo::gpu {

namespace {

/// A wait looks at the device this often.
constexpr std::uint64_t kLookNs = 1'000'000'000;
/// Looks in a row at which no thread of this process has worked, and looks at all on a device beside it.
constexpr int kMaxIdleLooks = 10, kMaxLooks = 600;
/// Less than this in a second is what waiting and looking take themselves: measured, 0.1 ms. A driver that
/// draws gets more even where fifty processes share a core.
constexpr double kIdleSeconds = 0.002;

VkResult waitFor(VkDevice device, const VkSemaphoreWaitInfo& info) {
  const VkResult result = vkWaitSemaphores(device, &info, kLookNs);
  check(result, "wait for the device");
  return result;
}

/// Time that this process has spent on processors.
double processorSeconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

Timeline::Timeline(VkDevice device, VkQueue queue, bool ofProcess)
    : device_(device), queue_(queue), ofProcess_(ofProcess) {
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
  double worked = processorSeconds();
  for (int looks = 0, idle = 0; waitFor(device_, info) == VK_TIMEOUT;) {
    const double now = processorSeconds();
    idle = now - worked < kIdleSeconds ? idle + 1 : 0;
    worked = now;
    ++looks;
    standsStill_ = ofProcess_ ? idle >= kMaxIdleLooks : looks >= kMaxLooks;
    if (standsStill_)
      throw Error(ErrorKind::Retry, "the Vulkan device does nothing with what it was given",
                  ofProcess_ ? "its driver could not start its threads: allow more processes (ulimit -u) or "
                               "memory (ulimit -v)"
                             : "choose another device; luxo doctor lists them");
  }
  completed_ = number;
}

}  // namespace luxo::gpu
