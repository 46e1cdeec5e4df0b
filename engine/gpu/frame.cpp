// SPDX-License-Identifier: Apache-2.0
#include "gpu/frame.h"

#include "base/assert.h"
#include "gpu/address_space.h"
#include "gpu/result.h"
#include "gpu/transfer.h"

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
  if (context.features().timestamps) timestamps_ = createTimestamps(context, 2 * kFrames);
}

FrameRing::~FrameRing() { drop(); }

void FrameRing::drop() {
  if (!recording_) return;
  recording_ = false;
  context_->timeline().destruction().recordingEnded();
}

VkCommandBuffer FrameRing::begin() {
  requireRoomForShaders("draw");  // which compiles what the first drawing with a pipeline needs
  if (!recording_) slot_ = (slot_ + 1) % kFrames;
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
    vkResetQueryPool(context_->device(), timestamps_, firstQuery(), 2);
    vkCmdWriteTimestamp2(frame.pool.commands, VK_PIPELINE_STAGE_2_TOP_OF_PIPE_BIT, timestamps_, firstQuery());
  }
  return frame.pool.commands;
}

std::uint64_t FrameRing::submit(std::span<const SemaphoreWait> waits, std::span<const VkSemaphore> signals) {
  LUXO_REQUIRE(recording_);
  Frame& frame = frames_[slot_];
  if (timestamps_) {
    vkCmdWriteTimestamp2(frame.pool.commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, timestamps_,
                         firstQuery() + 1);
  }
  check(vkEndCommandBuffer(frame.pool.commands), "end the recording of a frame");
  std::vector<VkCommandBuffer> commands;
  if (const VkCommandBuffer uploads = context_->uploads().finish()) commands.push_back(uploads);
  commands.push_back(frame.pool.commands);
  frame.submission = context_->timeline().submit(commands, waits, signals);
  context_->uploads().submitted();
  drop();
  return frame.submission;
}

std::optional<double> FrameRing::milliseconds(std::uint64_t submission) {
  if (!timestamps_ || submission == 0 || context_->timeline().completed() < submission) return std::nullopt;
  for (std::size_t slot = 0; slot < kFrames; ++slot) {
    if (frames_[slot].submission != submission) continue;
    std::array<std::uint64_t, 2> ticks{};
    const VkResult result =
        vkGetQueryPoolResults(context_->device(), timestamps_, static_cast<std::uint32_t>(2 * slot), 2,
                              sizeof(ticks), ticks.data(), sizeof(std::uint64_t), VK_QUERY_RESULT_64_BIT);
    check(result, "read the frame timestamps");
    if (result == VK_NOT_READY) return std::nullopt;
    return static_cast<double>(ticks[1] - ticks[0]) * context_->limits().timestampPeriod * 1e-6;
  }
  return std::nullopt;
}

}  // namespace luxo::gpu
