// SPDX-License-Identifier: Apache-2.0
#include "gpu/buffer.h"

#include "base/assert.h"
#include "gpu/debug.h"
#include "gpu/result.h"
#include "gpu/transfer.h"

#include <fmt/format.h>

#include <cstring>

namespace luxo::gpu {
namespace {

VkBufferUsageFlags transferUsage(MemoryUse memory) {
  switch (memory) {
    case MemoryUse::Device:
    case MemoryUse::Readback:
      return VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    case MemoryUse::Upload:
      return VK_BUFFER_USAGE_TRANSFER_SRC_BIT;
  }
  return 0;
}

Allocation allocateFor(Context& context, VkBuffer buffer, MemoryUse use) {
  VkMemoryDedicatedRequirements dedicated{.sType = VK_STRUCTURE_TYPE_MEMORY_DEDICATED_REQUIREMENTS};
  VkMemoryRequirements2 requirements{.sType = VK_STRUCTURE_TYPE_MEMORY_REQUIREMENTS_2, .pNext = &dedicated};
  const VkBufferMemoryRequirementsInfo2 info{.sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_REQUIREMENTS_INFO_2,
                                             .buffer = buffer};
  vkGetBufferMemoryRequirements2(context.device(), &info, &requirements);
  Allocation allocation = context.memory().allocate(
      {.requirements = requirements.memoryRequirements,
       .use = use,
       .tiling = Tiling::Linear,
       .dedicatedBuffer = dedicated.prefersDedicatedAllocation ? buffer : VK_NULL_HANDLE});
  if (use == MemoryUse::Device && !context.mapsDeviceMemory()) allocation.mapped = {};
  return allocation;
}

}  // namespace

Buffer::Buffer(Context& context, const BufferDesc& desc) : size_(desc.size) {
  LUXO_REQUIRE_COMPARE(desc.size, >, 0u);
  const VkBufferCreateInfo info{.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                                .size = desc.size,
                                .usage = desc.usage | transferUsage(desc.memory)};
  VkBuffer buffer = VK_NULL_HANDLE;
  const std::string attempted = fmt::format("create the buffer \"{}\" of {} bytes", desc.name, desc.size);
  check(vkCreateBuffer(context.device(), &info, nullptr, &buffer), attempted);
  buffer_ = {context, buffer};
  buffer_.own(allocateFor(context, buffer, desc.memory));
  const Allocation& memory = buffer_.memory();
  check(vkBindBufferMemory(context.device(), buffer, memory.memory, memory.offset), attempted);
  setName(context, buffer, desc.name);
}

void Buffer::write(VkDeviceSize offset, std::span<const std::byte> bytes) {
  LUXO_REQUIRE_COMPARE(offset, <=, size_);
  LUXO_REQUIRE_COMPARE(bytes.size(), <=, size_ - offset);
  if (bytes.empty()) return;
  Context& context = *buffer_.context();
  if (mapped().empty()) {
    context.uploads().add(buffer_, offset, bytes);
  } else {
    std::memcpy(mapped().data() + offset, bytes.data(), bytes.size());
    context.memory().flush(buffer_.memory(), offset, bytes.size());
  }
  context.counted().uploadedBytes += bytes.size();
}

std::span<std::byte> Buffer::mapped() const noexcept {
  const std::span<std::byte> memory = buffer_.memory().mapped;
  return memory.empty() ? memory : memory.first(size_);
}

void Buffer::flush() {
  LUXO_REQUIRE(!mapped().empty());
  buffer_.context()->memory().flush(buffer_.memory(), 0, size_);
}

std::span<const std::byte> Buffer::read() {
  LUXO_REQUIRE(!mapped().empty());
  buffer_.context()->memory().invalidate(buffer_.memory());
  return mapped();
}

Handle<VkBufferView> createTexelView(Context& context, const Buffer& buffer, VkFormat format) {
  const VkBufferViewCreateInfo info{.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO,
                                    .buffer = buffer,
                                    .format = format,
                                    .range = VK_WHOLE_SIZE};
  VkBufferView view = VK_NULL_HANDLE;
  check(vkCreateBufferView(context.device(), &info, nullptr, &view), "create a view of texels");
  return {context, view};
}

}  // namespace luxo::gpu
