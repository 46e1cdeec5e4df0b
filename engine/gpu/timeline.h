// SPDX-License-Identifier: Apache-2.0
// The device's queue and its clock: every submission gets the next number of one timeline semaphore.
#pragma once

#include "gpu/destruction_queue.h"
#include "gpu/vk.h"

#include <cstdint>
#include <span>

namespace luxo::gpu {

/// A binary semaphore that a submission waits for before `stage`.
struct SemaphoreWait {
  VkSemaphore semaphore = VK_NULL_HANDLE;
  VkPipelineStageFlags2 stage = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
};

/// Numbers start at 1; 0 is complete from the start.
class Timeline {
 public:
  /// `ofProcess`: the device's work is done by threads of this process, as drivers that draw on the processor
  /// do it.
  Timeline(VkDevice device, VkQueue queue, bool ofProcess);
  ~Timeline();
  Timeline(const Timeline&) = delete;
  Timeline& operator=(const Timeline&) = delete;

  /// Submits the command buffers as one batch and returns its number. Throws Error(Retry) when the device is
  /// lost.
  std::uint64_t submit(std::span<const VkCommandBuffer> commands, std::span<const SemaphoreWait> waits = {},
                       std::span<const VkSemaphore> signals = {});

  [[nodiscard]] std::uint64_t submitted() const noexcept { return submitted_; }
  /// The last number whose work is complete, as the device says now.
  [[nodiscard]] std::uint64_t completed();
  /// Blocks until `number` is complete; at once when it is. Requires that `number` has been submitted. Throws
  /// Error(Retry) when the device stands still: one of this process when none of its threads has done
  /// anything for ten seconds (its driver could not start them), another after ten minutes, long after its
  /// kernel driver should have reset it.
  void wait(std::uint64_t number);
  /// Whether a wait was given up. What such a device uses can never be destroyed.
  [[nodiscard]] bool standsStill() const noexcept { return standsStill_; }

  /// Where the handles of this device go when they are dropped.
  [[nodiscard]] DestructionQueue& destruction() noexcept { return destruction_; }
  /// Destroys what the device has finished with. Cheap; every frame does it.
  void collect() { destruction_.collect(completed()); }

 private:
  VkDevice device_;
  VkQueue queue_;
  bool ofProcess_;
  bool standsStill_ = false;
  VkSemaphore semaphore_ = VK_NULL_HANDLE;
  std::uint64_t submitted_ = 0;
  std::uint64_t completed_ = 0;
  DestructionQueue destruction_;
};

}  // namespace luxo::gpu
