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
#include <string_view>
#include <vector>

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
  /// How many that was so far.
  [[nodiscard]] std::uint64_t thrownAway() const noexcept { return thrownAway_; }

  /// Which set of per-frame resources the open recording may write: 0 .. kFrames - 1.
  [[nodiscard]] std::size_t slot() const noexcept { return slot_; }
  /// Descriptor sets for the open recording.
  [[nodiscard]] DescriptorArena& descriptors() noexcept { return frames_[slot_].descriptors; }

  /// Ends the recording and submits it, staged buffer writes ahead of it. Returns its number on the timeline.
  std::uint64_t submit(std::span<const SemaphoreWait> waits = {}, std::span<const VkSemaphore> signals = {});

  /// What is recorded from here on, until the next mark or the end of the frame, is the part of that name.
  /// Outside of rendering. `name` outlives all frames. Nothing without timestamps.
  void mark(std::string_view name);

  void wait(std::uint64_t submission) { context_->timeline().wait(submission); }

  /// Time the device took for a complete submission, from first to last command. Nothing without timestamps,
  /// before it is complete, or once its slot is in use again.
  [[nodiscard]] std::optional<double> milliseconds(std::uint64_t submission);

  struct Part {
    std::string_view name;
    double milliseconds = 0;
  };
  /// The same by parts, in the order of their first marks; those of one name are one. Together they are
  /// milliseconds(): what comes before the first mark is kUnmarked. What the device does at once, by no
  /// barrier apart, counts for the part that was recorded first. Empty where milliseconds() gives nothing.
  [[nodiscard]] std::vector<Part> parts(std::uint64_t submission);
  static constexpr std::string_view kUnmarked = "other";
  /// A frame has at most that many marks: what comes later is kUnmarked, too.
  static constexpr std::size_t kMaxMarks = 126;

 private:
  struct Frame {
    explicit Frame(Context& context) : pool(context), descriptors(context) {}
    CommandPool pool;
    DescriptorArena descriptors;
    std::uint64_t submission = 0;
    std::vector<std::string_view> marks = {};
  };
  static constexpr std::uint32_t kQueries = kMaxMarks + 2;  // of a frame: its first, its marks, its last

  void drop();
  /// Into the open recording: the moment when all that was recorded before is done.
  void writeTimestamp(std::size_t query, VkPipelineStageFlags2 stage);
  /// Of a complete submission, and nothing otherwise: one for each timestamp of its frame.
  [[nodiscard]] std::vector<std::uint64_t> ticksOf(std::size_t slot) const;
  [[nodiscard]] std::optional<std::size_t> completeSlotOf(std::uint64_t submission) const;
  [[nodiscard]] double millisecondsOf(std::uint64_t ticks) const;

  Context* context_;
  Handle<VkQueryPool> timestamps_;  // kQueries of each frame; empty without
  std::array<Frame, kFrames> frames_;
  std::size_t slot_ = kFrames - 1;
  bool recording_ = false;
  std::uint64_t thrownAway_ = 0;
};

}  // namespace luxo::gpu
