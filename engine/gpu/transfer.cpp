// SPDX-License-Identifier: Apache-2.0
#include "gpu/transfer.h"

#include "base/assert.h"
#include "gpu/barrier.h"
#include "gpu/result.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace luxo::gpu {
namespace {

void memoryBarrier(VkCommandBuffer commands, const VkMemoryBarrier2& barrier) {
  const VkDependencyInfo info{
      .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .memoryBarrierCount = 1, .pMemoryBarriers = &barrier};
  vkCmdPipelineBarrier2(commands, &info);
}

}  // namespace

Readback::Readback(Context& context, VkExtent2D extent, VkFormat format, std::uint32_t rowPitch)
    : extent_(extent), format_(format) {
  const std::uint32_t texel = bytesPerTexel(format);
  const std::uint32_t tight = extent.width * texel;
  rowPitch_ = rowPitch == 0 ? tight : rowPitch;
  LUXO_REQUIRE_COMPARE(rowPitch_, >=, tight);
  LUXO_REQUIRE_COMPARE(rowPitch_ % texel, ==, 0u);
  buffer_ = {
      context,
      {.size = VkDeviceSize{rowPitch_} * extent.height, .memory = MemoryUse::Readback, .name = "readback"}};
}

void Readback::record(VkCommandBuffer commands, Texture& texture) {
  const Rows all[] = {{0, extent_.height}};
  record(commands, texture, all);
}

void Readback::record(VkCommandBuffer commands, Texture& texture, std::span<const Rows> rows) {
  LUXO_REQUIRE_COMPARE(texture.extent().width, ==, extent_.width);
  LUXO_REQUIRE_COMPARE(texture.extent().height, ==, extent_.height);
  LUXO_REQUIRE(texture.format() == format_ && texture.samples() == VK_SAMPLE_COUNT_1_BIT);
  use(commands, {{texture, Use::TransferSource}, {buffer_, Use::TransferDestination}});
  std::vector<VkBufferImageCopy> regions;
  for (const auto& [first, count] : rows)
    regions.push_back({.bufferOffset = VkDeviceSize{first} * rowPitch_,
                       .bufferRowLength = rowPitch_ / bytesPerTexel(format_),
                       .imageSubresource = {.aspectMask = aspectOf(format_), .layerCount = 1},
                       .imageOffset = {0, static_cast<std::int32_t>(first), 0},
                       .imageExtent = {extent_.width, count, 1}});
  vkCmdCopyImageToBuffer(commands, texture, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, buffer_,
                         static_cast<std::uint32_t>(regions.size()), regions.data());
  use(commands, {{buffer_, Use::HostRead}});
}

std::span<const std::byte> Readback::row(std::uint32_t y) {
  LUXO_REQUIRE_COMPARE(y, <, extent_.height);
  return bytes().subspan(std::size_t{y} * rowPitch_, std::size_t{extent_.width} * bytesPerTexel(format_));
}

void Uploads::add(VkBuffer destination, VkDeviceSize offset, std::span<const std::byte> bytes) {
  if (!staged()) begin();
  orderAfterEarlierWrites(destination);
  Chunk& chunk = room(bytes.size());
  std::memcpy(chunk.buffer.mapped().data() + chunk.used, bytes.data(), bytes.size());
  const VkBufferCopy region{.srcOffset = chunk.used, .dstOffset = offset, .size = bytes.size()};
  vkCmdCopyBuffer(batch_.pool.commands, chunk.buffer, destination, 1, &region);
  chunk.used += bytes.size();
}

void Uploads::begin() {
  batch_.pool = CommandPool(*context_);
  batch_.pool.begin();
  // Until it is submitted, the batch uses its destinations like any other recording.
  context_->timeline().destruction().recordingBegan();
  memoryBarrier(batch_.pool.commands, {.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
                                       .srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                                       .srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT,
                                       .dstStageMask = VK_PIPELINE_STAGE_2_COPY_BIT,
                                       .dstAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT});
}

void Uploads::orderAfterEarlierWrites(VkBuffer destination) {
  if (std::ranges::find(batch_.written, destination) != batch_.written.end()) {
    memoryBarrier(batch_.pool.commands, {.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
                                         .srcStageMask = VK_PIPELINE_STAGE_2_COPY_BIT,
                                         .srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT,
                                         .dstStageMask = VK_PIPELINE_STAGE_2_COPY_BIT,
                                         .dstAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT});
    batch_.written.clear();
  }
  batch_.written.push_back(destination);
}

Uploads::Chunk& Uploads::room(VkDeviceSize size) {
  if (!batch_.chunks.empty()) {
    Chunk& last = batch_.chunks.back();
    if (last.buffer.size() - last.used >= size) return last;
  }
  return batch_.chunks.emplace_back(Chunk{
      .buffer = Buffer(
          *context_, {.size = std::max(size, kChunkSize), .memory = MemoryUse::Upload, .name = "staging"})});
}

VkCommandBuffer Uploads::finish() {
  if (!staged()) return VK_NULL_HANDLE;
  for (Chunk& chunk : batch_.chunks) chunk.buffer.flush();
  memoryBarrier(batch_.pool.commands,
                {.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
                 .srcStageMask = VK_PIPELINE_STAGE_2_COPY_BIT,
                 .srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT,
                 .dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                 .dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT});
  check(vkEndCommandBuffer(batch_.pool.commands), "end the recording of uploads");
  return batch_.pool.commands;
}

void Uploads::submitted() {
  if (!staged()) return;
  batch_ = {};  // its handles go when the device is done with the submission
  context_->timeline().destruction().recordingEnded();
}

}  // namespace luxo::gpu
