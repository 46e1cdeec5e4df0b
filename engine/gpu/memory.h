// SPDX-License-Identifier: Apache-2.0
// Device memory, allocated in blocks and handed out in parts: drivers allow few allocations and make them
// slow.
#pragma once

#include "gpu/free_list.h"
#include "gpu/vk.h"

#include <cstddef>
#include <list>
#include <optional>
#include <span>

namespace luxo::gpu {

/// Who touches the memory.
enum class MemoryUse {
  Device,    ///< the device reads and writes it fast; the host may or may not be able to map it
  Upload,    ///< the host writes it in order, the device reads it
  Readback,  ///< the device writes it, the host reads it (from its cache where there is such memory)
};

/// The best memory type of those in `allowedTypes` (a bit per type), or nothing when none serves. Pure.
[[nodiscard]] std::optional<std::uint32_t> chooseMemoryType(const VkPhysicalDeviceMemoryProperties& memory,
                                                            std::uint32_t allowedTypes, MemoryUse use);

/// Buffers and optimally tiled images live in separate blocks, so that bufferImageGranularity never matters.
enum class Tiling { Linear, Optimal };

struct MemoryBlock;

/// A part of a block. Plain data: whoever got it gives it back to Memory::free when the device is done with
/// it.
struct Allocation {
  MemoryBlock* block = nullptr;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  VkDeviceSize offset = 0;  ///< in `memory`
  VkDeviceSize size = 0;
  std::span<std::byte> mapped;  ///< the same bytes as the host sees them; empty when it cannot
};

struct AllocationDesc {
  VkMemoryRequirements requirements{};
  MemoryUse use = MemoryUse::Device;
  Tiling tiling = Tiling::Linear;
  /// Set at most one to give the resource an allocation of its own, as the driver may prefer for render
  /// targets.
  VkBuffer dedicatedBuffer = VK_NULL_HANDLE;
  VkImage dedicatedImage = VK_NULL_HANDLE;
};

/// The allocator of one device. Blocks are 16 MiB, mapped for as long as they live when the host can see
/// them; what is larger than half a block, or dedicated, gets its own. Single-threaded.
class Memory {
 public:
  static constexpr VkDeviceSize kBlockSize = VkDeviceSize{16} << 20;

  Memory(VkPhysicalDevice physicalDevice, VkDevice device);
  ~Memory();
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;

  /// Throws Error(Retry) when the device is out of memory, Error(Device) when it never gives that much at
  /// once.
  [[nodiscard]] Allocation allocate(const AllocationDesc& desc);
  void free(const Allocation& allocation);

  /// Makes host writes to the allocation visible to later submissions. Free on coherent memory.
  void flush(const Allocation& allocation, VkDeviceSize offset, VkDeviceSize size);
  /// Makes finished device writes to the allocation visible to the host. Free on coherent memory.
  void invalidate(const Allocation& allocation);

  [[nodiscard]] std::uint64_t usedBytes() const noexcept { return usedBytes_; }
  [[nodiscard]] std::uint64_t reservedBytes() const noexcept { return reservedBytes_; }
  [[nodiscard]] std::uint64_t allocations() const noexcept { return allocations_; }
  [[nodiscard]] std::size_t blocks() const noexcept;
  /// Bytes that the driver gives at most at once, and all together.
  [[nodiscard]] std::uint64_t largestAllocation() const noexcept { return largest_; }
  [[nodiscard]] std::uint64_t largestHeap() const noexcept;

 private:
  MemoryBlock& addBlock(const AllocationDesc& desc, std::uint32_t type, VkDeviceSize size, bool shared);
  void removeBlock(MemoryBlock& block);
  [[nodiscard]] bool coherent(const Allocation& allocation) const;
  [[nodiscard]] VkMappedMemoryRange mappedRange(const Allocation& allocation, VkDeviceSize offset,
                                                VkDeviceSize size) const;
  [[nodiscard]] Allocation take(MemoryBlock& block, VkDeviceSize offset, VkDeviceSize size);

  VkDevice device_;
  VkPhysicalDeviceMemoryProperties properties_{};
  VkDeviceSize atomSize_ = 1;
  VkDeviceSize largest_ = 0;       // the driver's limit for one allocation
  std::list<MemoryBlock> blocks_;  // a list, since allocations point into it
  std::uint64_t usedBytes_ = 0;
  std::uint64_t reservedBytes_ = 0;
  std::uint64_t allocations_ = 0;
};

}  // namespace luxo::gpu
