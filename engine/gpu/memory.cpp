// SPDX-License-Identifier: Apache-2.0
#include "gpu/memory.h"

#include "base/assert.h"
#include "base/error.h"
#include "gpu/result.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace luxo::gpu {

struct MemoryBlock {
  VkDeviceMemory memory = VK_NULL_HANDLE;
  std::uint32_t type = 0;
  Tiling tiling = Tiling::Linear;
  bool shared = true;  // false: belongs to one allocation
  FreeList free;
  std::byte* mapped = nullptr;
};

namespace {

struct Preference {
  VkMemoryPropertyFlags wanted;
  VkMemoryPropertyFlags unwanted;
};

constexpr VkMemoryPropertyFlags kDeviceLocal = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
constexpr VkMemoryPropertyFlags kVisible = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT;
constexpr VkMemoryPropertyFlags kCoherent = VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
constexpr VkMemoryPropertyFlags kCached = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
// Memory that only special resources may use.
constexpr VkMemoryPropertyFlags kSpecial =
    VK_MEMORY_PROPERTY_PROTECTED_BIT | VK_MEMORY_PROPERTY_LAZILY_ALLOCATED_BIT |
    VK_MEMORY_PROPERTY_DEVICE_COHERENT_BIT_AMD | VK_MEMORY_PROPERTY_DEVICE_UNCACHED_BIT_AMD;

// Best first. The part of a graphics card's memory that the host sees may be small, so it is left to those
// who ask.
std::span<const Preference> preferences(MemoryUse use) {
  static constexpr std::array kDevice{Preference{kDeviceLocal, kVisible}, Preference{kDeviceLocal, 0},
                                      Preference{0, 0}};
  static constexpr std::array kUpload{Preference{kVisible | kCoherent, kDeviceLocal | kCached},
                                      Preference{kVisible | kCoherent, kDeviceLocal},
                                      Preference{kVisible | kCoherent, 0}, Preference{kVisible, 0}};
  static constexpr std::array kReadback{Preference{kVisible | kCached | kCoherent, 0},
                                        Preference{kVisible | kCached, 0}, Preference{kVisible, 0}};
  switch (use) {
    case MemoryUse::Upload:
      return kUpload;
    case MemoryUse::Readback:
      return kReadback;
    case MemoryUse::Device:
      break;
  }
  return kDevice;
}

VkDeviceSize roundUp(VkDeviceSize value, VkDeviceSize multiple) {
  return (value + multiple - 1) / multiple * multiple;
}

}  // namespace

std::optional<std::uint32_t> chooseMemoryType(const VkPhysicalDeviceMemoryProperties& memory,
                                              std::uint32_t allowedTypes, MemoryUse use) {
  for (const Preference& preference : preferences(use)) {
    for (std::uint32_t type = 0; type < memory.memoryTypeCount; ++type) {
      const VkMemoryPropertyFlags flags = memory.memoryTypes[type].propertyFlags;
      const bool allowed = (allowedTypes >> type & 1u) != 0 && (flags & kSpecial) == 0;
      const bool fits =
          (flags & preference.wanted) == preference.wanted && (flags & preference.unwanted) == 0;
      if (allowed && fits) return type;
    }
  }
  return std::nullopt;
}

Memory::Memory(VkPhysicalDevice physicalDevice, VkDevice device) : device_(device) {
  vkGetPhysicalDeviceMemoryProperties(physicalDevice, &properties_);
  VkPhysicalDeviceMaintenance3Properties limits{
      .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES};
  VkPhysicalDeviceProperties2 properties{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2,
                                         .pNext = &limits};
  vkGetPhysicalDeviceProperties2(physicalDevice, &properties);
  atomSize_ = properties.properties.limits.nonCoherentAtomSize;
  largest_ = limits.maxMemoryAllocationSize;
}

Memory::~Memory() {
  for (const MemoryBlock& block : blocks_) vkFreeMemory(device_, block.memory, nullptr);
}

std::size_t Memory::blocks() const noexcept { return blocks_.size(); }

std::uint64_t Memory::largestHeap() const noexcept {
  std::uint64_t largest = 0;
  for (std::uint32_t i = 0; i < properties_.memoryHeapCount; ++i)
    largest = std::max<std::uint64_t>(largest, properties_.memoryHeaps[i].size);
  return largest;
}

Allocation Memory::allocate(const AllocationDesc& desc) {
  const std::optional<std::uint32_t> type =
      chooseMemoryType(properties_, desc.requirements.memoryTypeBits, desc.use);
  if (!type) {
    throw Error(ErrorKind::Device,
                fmt::format("cannot allocate {} bytes: the device has no fitting memory type",
                            desc.requirements.size));
  }
  // A dedicated allocation is no larger than what it is for
  // (VUID-VkMemoryDedicatedAllocateInfo-buffer-01435).
  const VkDeviceSize needed = desc.requirements.size;
  const bool dedicated = desc.dedicatedBuffer != VK_NULL_HANDLE || desc.dedicatedImage != VK_NULL_HANDLE;
  if (dedicated || needed > kBlockSize / 2) return take(addBlock(desc, *type, needed, false), 0, needed);

  // Whole atoms, so that invalidating one allocation never touches another.
  const VkDeviceSize size = roundUp(needed, atomSize_);
  const VkDeviceSize alignment = std::max(desc.requirements.alignment, atomSize_);

  for (MemoryBlock& block : blocks_) {
    if (!block.shared || block.type != *type || block.tiling != desc.tiling) continue;
    if (const auto offset = block.free.allocate(size, alignment)) return take(block, *offset, size);
  }
  MemoryBlock& block = addBlock(desc, *type, kBlockSize, true);
  return take(block, block.free.allocate(size, alignment).value(), size);
}

Allocation Memory::take(MemoryBlock& block, VkDeviceSize offset, VkDeviceSize size) {
  ++allocations_;
  usedBytes_ += size;
  Allocation result{.block = &block, .memory = block.memory, .offset = offset, .size = size};
  if (block.mapped != nullptr) result.mapped = {block.mapped + offset, size};
  return result;
}

void Memory::free(const Allocation& allocation) {
  if (allocation.block == nullptr) return;
  MemoryBlock& block = *allocation.block;
  --allocations_;
  usedBytes_ -= allocation.size;
  if (!block.shared) return removeBlock(block);

  block.free.free(allocation.offset, allocation.size);
  if (!block.free.unused()) return;
  // One empty block of a kind is kept, so that a resource made and dropped in every frame costs no system
  // call.
  const bool spare = std::ranges::any_of(blocks_, [&](const MemoryBlock& other) {
    return &other != &block && other.shared && other.type == block.type && other.tiling == block.tiling;
  });
  if (spare) removeBlock(block);
}

MemoryBlock& Memory::addBlock(const AllocationDesc& desc, std::uint32_t type, VkDeviceSize size,
                              bool shared) {
  const VkMemoryDedicatedAllocateInfo dedicated{.sType = VK_STRUCTURE_TYPE_MEMORY_DEDICATED_ALLOCATE_INFO,
                                                .image = desc.dedicatedImage,
                                                .buffer = desc.dedicatedBuffer};
  const VkMemoryAllocateInfo info{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                  .pNext = shared ? nullptr : &dedicated,
                                  .allocationSize = size,
                                  .memoryTypeIndex = type};
  if (size > largest_)
    throw Error(
        ErrorKind::Device,
        fmt::format("cannot allocate {} MiB of device memory: this device gives at most {} MiB at once",
                    size >> 20, largest_ >> 20),
        "use a smaller picture or fewer samples");
  VkDeviceMemory memory = VK_NULL_HANDLE;
  const VkResult result = vkAllocateMemory(device_, &info, nullptr, &memory);
  if (result != VK_SUCCESS) {
    throwResult(result, fmt::format("allocate {} MiB of device memory (with {} MiB in use)", size >> 20,
                                    reservedBytes_ >> 20));
  }
  MemoryBlock& block = blocks_.emplace_back(MemoryBlock{
      .memory = memory, .type = type, .tiling = desc.tiling, .shared = shared, .free = FreeList(size)});
  reservedBytes_ += size;
  if ((properties_.memoryTypes[type].propertyFlags & kVisible) != 0) {
    void* mapped = nullptr;
    const VkResult mapResult = vkMapMemory(device_, memory, 0, VK_WHOLE_SIZE, 0, &mapped);
    if (mapResult != VK_SUCCESS) {
      removeBlock(block);
      throwResult(mapResult, fmt::format("map {} MiB of device memory", size >> 20));
    }
    block.mapped = static_cast<std::byte*>(mapped);
  }
  return block;
}

void Memory::removeBlock(MemoryBlock& block) {
  reservedBytes_ -= block.free.size();
  vkFreeMemory(device_, block.memory, nullptr);
  blocks_.remove_if([&](const MemoryBlock& other) { return &other == &block; });
}

VkMappedMemoryRange Memory::mappedRange(const Allocation& allocation, VkDeviceSize offset,
                                        VkDeviceSize size) const {
  const VkDeviceSize begin = (allocation.offset + offset) / atomSize_ * atomSize_;
  const VkDeviceSize end =
      std::min(roundUp(allocation.offset + offset + size, atomSize_), allocation.block->free.size());
  return {.sType = VK_STRUCTURE_TYPE_MAPPED_MEMORY_RANGE,
          .memory = allocation.memory,
          .offset = begin,
          .size = end == allocation.block->free.size() ? VK_WHOLE_SIZE : end - begin};
}

bool Memory::coherent(const Allocation& allocation) const {
  return (properties_.memoryTypes[allocation.block->type].propertyFlags & kCoherent) != 0;
}

void Memory::flush(const Allocation& allocation, VkDeviceSize offset, VkDeviceSize size) {
  LUXO_REQUIRE(!allocation.mapped.empty());
  if (size == 0 || coherent(allocation)) return;
  const VkMappedMemoryRange range = mappedRange(allocation, offset, size);
  check(vkFlushMappedMemoryRanges(device_, 1, &range), "flush host writes");
}

void Memory::invalidate(const Allocation& allocation) {
  LUXO_REQUIRE(!allocation.mapped.empty());
  if (coherent(allocation)) return;
  const VkMappedMemoryRange range = mappedRange(allocation, 0, allocation.size);
  check(vkInvalidateMappedMemoryRanges(device_, 1, &range), "read device writes");
}

}  // namespace luxo::gpu
