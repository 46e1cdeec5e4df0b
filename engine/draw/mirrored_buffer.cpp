// SPDX-License-Identifier: Apache-2.0
#include "draw/mirrored_buffer.h"

#include <algorithm>
#include <cstring>

#include "base/assert.h"

namespace luxo {

const gpu::Buffer& MirroredBuffer::use(gpu::Context& context) {
  Slot& slot = slots_[current_];
  slot.lastUse = context.timeline().submitted() + 1;
  return slot.buffer;
}

void MirroredBuffer::write(gpu::Context& context, std::span<const std::byte> bytes, VkBufferUsageFlags usage,
                           const char* name, bool always) {
  LUXO_REQUIRE_COMPARE(bytes.size(), >, std::size_t{0});
  const bool same =
      bytes.size() == bytes_.size() && std::memcmp(bytes.data(), bytes_.data(), bytes.size()) == 0;
  if (same && !always) return;
  gpu::Timeline& timeline = context.timeline();
  // A recording that was thrown away never becomes a submission.
  const auto inUse = [&](const Slot& slot) {
    return std::min(slot.lastUse, timeline.submitted()) > timeline.completed();
  };
  if (inUse(slots_[current_])) current_ = (current_ + 1) % slots_.size();
  Slot& slot = slots_[current_];
  if (inUse(slot)) timeline.wait(std::min(slot.lastUse, timeline.submitted()));
  if (!slot.buffer || slot.buffer.size() < bytes.size())
    slot.buffer = gpu::Buffer(
        context,
        {.size = std::max<VkDeviceSize>(bytes.size(), 2 * bytes_.size()), .usage = usage, .name = name});
  slot.buffer.write(0, bytes);
  bytes_.assign(bytes.begin(), bytes.end());
}

}  // namespace luxo
