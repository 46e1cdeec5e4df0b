// SPDX-License-Identifier: Apache-2.0
// Frames: recording one while the device works on the one before.
#pragma once

#include "gpu/command_pool.h"
#include "gpu/descriptor.h"
#include "gpu/handle.h"
#include "gpu/timeline.h"
#include "gpu/vk.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>

namespace luxo::gpu {

/// A ring of two frames, for offscreen pictures and swapchains alike:
///     FrameRing frames(context);
///     VkCommandBuffer commands = frames.begin();
///     ...
///     frames.wait(frames.submit());      // or draw on, and wait for the number later
class FrameRing {
 public:
  static constexpr std::size_t kFrames = 2;

  explicit FrameRing(Context& context);
  ~FrameRing();
  FrameRing(const FrameRing&) = delete;
  FrameRing& operator=(const FrameRing&) = delete;

  /// Waits for this slot's earlier submission, destroys what was dropped and is done, and begins to record. A
  /// recording that was begun and not submitted is thrown away (the tracked uses of its resources are not).
  VkCommandBuffer begin();

  /// Which set of per-frame resources the open recording may write: 0 .. kFrames - 1.
  [[nodiscard]] std::size_t slot() const noexcept { return slot_; }
  /// Descriptor sets for the open recording.
  [[nodiscard]] DescriptorArena& descriptors() noexcept { return frames_[slot_].descriptors; }

  /// Ends the recording and submits it, staged buffer writes ahead of it. Returns its number on the timeline.
  std::uint64_t submit(std::span<const SemaphoreWait> waits = {}, std::span<const VkSemaphore> signals = {});

  void wait(std::uint64_t submission) { context_->timeline().wait(submission); }

  /// Time the device took for a complete submission, from first to last command. Nothing without timestamps,
  /// before it is complete, or once its slot is in use again.
  [[nodiscard]] std::optional<double> milliseconds(std::uint64_t submission);

 private:
  struct Frame {
    explicit Frame(Context& context) : pool(context), descriptors(context) {}
    CommandPool pool;
    DescriptorArena descriptors;
    std::uint64_t submission = 0;
  };

  void drop();
  [[nodiscard]] std::uint32_t firstQuery() const noexcept { return static_cast<std::uint32_t>(2 * slot_); }

  Context* context_;
  Handle<VkQueryPool> timestamps_;  // first and last of each frame; empty without
  std::array<Frame, kFrames> frames_;
  std::size_t slot_ = kFrames - 1;
  bool recording_ = false;
};

}  // namespace luxo::gpu
