// SPDX-License-Identifier: Apache-2.0
#include "gpu/frame.h"

#include "base/assert.h"
#include "gpu/address_space.h"
#include "gpu/result.h"
#include "gpu/transfer.h"

#include <algorithm>
#include <vector>

namespace luxo::gpu {
namespace {

Handle<VkQueryPool> createTimestamps(Context& context, std::uint32_t count) {
  const VkQueryPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
                                   .queryType = VK_QUERY_TYPE_TIMESTAMP,
                                   .queryCount = count};
  VkQueryPool pool = VK_NULL_HANDLE;
  check(vkCreateQueryPool(context.device(), &info, nullptr, &pool), "create the frame timestamps");
  return {context, pool};
}

}  // namespace

FrameRing::FrameRing(Context& context) : context_(&context), frames_{Frame(context), Frame(context)} {
  static_assert(kFrames == 2);
  if (context.features().timestamps) timestamps_ = createTimestamps(context, kQueries * kFrames);
}

FrameRing::~FrameRing() { drop(); }

void FrameRing::drop() {
  if (!recording_) return;
  recording_ = false;
  context_->timeline().destruction().recordingEnded();
}

VkCommandBuffer FrameRing::begin() {
  requireRoomForShaders("draw");  // which compiles what the first drawing with a pipeline needs
  if (recording_)
    ++thrownAway_;
  else
    slot_ = (slot_ + 1) % kFrames;
  drop();
  Frame& frame = frames_[slot_];
  context_->timeline().wait(frame.submission);
  context_->timeline().collect();
  frame.descriptors.reset();
  frame.submission = 0;
  frame.pool.begin();
  recording_ = true;
  context_->timeline().destruction().recordingBegan();
  if (timestamps_) {
    frame.marks.clear();
    vkResetQueryPool(context_->device(), timestamps_, static_cast<std::uint32_t>(slot_ * kQueries), kQueries);
    writeTimestamp(0, VK_PIPELINE_STAGE_2_TOP_OF_PIPE_BIT);
  }
  return frame.pool.commands;
}

std::uint64_t FrameRing::submit(std::span<const SemaphoreWait> waits, std::span<const VkSemaphore> signals) {
  LUXO_REQUIRE(recording_);
  Frame& frame = frames_[slot_];
  if (timestamps_) writeTimestamp(frame.marks.size() + 1, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT);
  check(vkEndCommandBuffer(frame.pool.commands), "end the recording of a frame");
  std::vector<VkCommandBuffer> commands;
  if (const VkCommandBuffer uploads = context_->uploads().finish()) commands.push_back(uploads);
  commands.push_back(frame.pool.commands);
  frame.submission = context_->timeline().submit(commands, waits, signals);
  context_->uploads().submitted();
  drop();
  return frame.submission;
}

void FrameRing::mark(std::string_view name) {
  LUXO_REQUIRE(recording_);
  if (!timestamps_) return;
  std::vector<std::string_view>& marks = frames_[slot_].marks;
  if (marks.size() == kMaxMarks) return;
  marks.push_back(marks.size() + 1 < kMaxMarks ? name : kUnmarked);
  writeTimestamp(marks.size(), VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT);
}

void FrameRing::writeTimestamp(std::size_t query, VkPipelineStageFlags2 stage) {
  vkCmdWriteTimestamp2(frames_[slot_].pool.commands, stage, timestamps_,
                       static_cast<std::uint32_t>(slot_ * kQueries + query));
}

std::optional<std::size_t> FrameRing::completeSlotOf(std::uint64_t submission) const {
  if (!timestamps_ || submission == 0 || context_->timeline().completed() < submission) return std::nullopt;
  for (std::size_t slot = 0; slot < kFrames; ++slot)
    if (frames_[slot].submission == submission) return slot;
  return std::nullopt;
}

std::vector<std::uint64_t> FrameRing::ticksOf(std::size_t slot) const {
  std::vector<std::uint64_t> ticks(frames_[slot].marks.size() + 2);
  const VkResult result =
      vkGetQueryPoolResults(context_->device(), timestamps_, static_cast<std::uint32_t>(slot * kQueries),
                            static_cast<std::uint32_t>(ticks.size()), ticks.size() * sizeof(std::uint64_t),
                            ticks.data(), sizeof(std::uint64_t), VK_QUERY_RESULT_64_BIT);
  check(result, "read the frame timestamps");
  return result == VK_NOT_READY ? std::vector<std::uint64_t>{} : ticks;
}

double FrameRing::millisecondsOf(std::uint64_t ticks) const {
  return static_cast<double>(ticks) * context_->limits().timestampPeriod * 1e-6;
}

std::optional<double> FrameRing::milliseconds(std::uint64_t submission) {
  const std::optional<std::size_t> slot = completeSlotOf(submission);
  if (!slot) return std::nullopt;
  const std::vector<std::uint64_t> ticks = ticksOf(*slot);
  if (ticks.empty()) return std::nullopt;
  return millisecondsOf(ticks.back() - ticks.front());
}

std::vector<FrameRing::Part> FrameRing::parts(std::uint64_t submission) {
  const std::optional<std::size_t> slot = completeSlotOf(submission);
  if (!slot) return {};
  const std::vector<std::uint64_t> ticks = ticksOf(*slot);
  std::vector<Part> parts;
  for (std::size_t i = 0; i + 1 < ticks.size(); ++i) {
    const std::string_view name = i == 0 ? kUnmarked : frames_[*slot].marks[i - 1];
    const double milliseconds = millisecondsOf(ticks[i + 1] - ticks[i]);
    const auto known = std::ranges::find(parts, name, &Part::name);
    if (known == parts.end())
      parts.push_back({name, milliseconds});
    else
      known->milliseconds += milliseconds;
  }
  return parts;
}

}  // namespace luxo::gpu
