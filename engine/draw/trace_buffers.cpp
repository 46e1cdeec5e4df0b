// SPDX-License-Identifier: Apache-2.0
#include "draw/trace_buffers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "base/error.h"
#include "gpu/barrier.h"

namespace luxo {

void TraceBuffers::prepare(VkExtent2D extent) {
  pixels_ = std::size_t{extent.width} * extent.height;
  const VkDeviceSize bytes = pixels_ * sizeof(shared::TraceQuestion);
  requireRoom(bytes);
  if (!questions_ || questions_.size() < bytes) {
    gpu::Timeline& timeline = context_->timeline();
    timeline.wait(timeline.submitted());
    questions_ = {};
    questions_ = gpu::Buffer(*context_,
                             {.size = bytes,
                              .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                              .memory = gpu::MemoryUse::Readback,
                              .name = "questions of shaders"});
  }
  answer(std::vector<std::uint32_t>(pixels_ + 1), {});
}

void TraceBuffers::answer(const std::vector<std::uint32_t>& starts,
                          const std::vector<shared::TraceAnswer>& answers) {
  static const shared::TraceAnswer kNone{};
  const std::span<const shared::TraceAnswer> all(answers.empty() ? &kNone : answers.data(),
                                                 std::max<std::size_t>(answers.size(), 1));
  requireRoom(all.size_bytes());
  starts_.write(*context_, std::as_bytes(std::span(starts)), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                "where answers start", false);
  answers_.write(*context_, std::as_bytes(all), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "answers to shaders",
                 false);
}

void TraceBuffers::requireRoom(VkDeviceSize bytes) const {
  const VkDeviceSize most = context_->limits().maxStorageBufferRange;
  if (bytes > most)
    throw Error(ErrorKind::Device,
                fmt::format("the rays that shaders send from the points of one picture take {} MiB, and this "
                            "device binds {} at once",
                            bytes >> 20, most >> 20),
                "draw a smaller picture, or send fewer rays from a point");
}

void TraceBuffers::clear(VkCommandBuffer commands) {
  gpu::use(commands, {{questions_, gpu::Use::TransferDestination}});
  vkCmdFillBuffer(commands, questions_, 0, VK_WHOLE_SIZE, 0);
}

std::vector<shared::TraceQuestion> TraceBuffers::asked() {
  std::vector<shared::TraceQuestion> questions(pixels_);
  std::memcpy(questions.data(), questions_.read().data(), questions.size() * sizeof questions[0]);
  return questions;
}

}  // namespace luxo
