// SPDX-License-Identifier: Apache-2.0
// Which parts of one block of memory are free. Knows offsets only, so it needs no device.
#pragma once

#include <cstdint>
#include <map>
#include <optional>

namespace luxo::gpu {

/// First fit over the free ranges in order of offset. O(free ranges) to allocate, O(log) to free;
/// neighbouring free ranges are joined at once, so that all freed is one range again.
class FreeList {
 public:
  explicit FreeList(std::uint64_t size);

  /// The offset of `size` > 0 bytes, a multiple of `alignment` (a power of two), or nothing when none fits.
  [[nodiscard]] std::optional<std::uint64_t> allocate(std::uint64_t size, std::uint64_t alignment);

  /// Takes back exactly one allocation. Requires that no byte of it is free already.
  void free(std::uint64_t offset, std::uint64_t size);

  [[nodiscard]] bool unused() const noexcept { return freeBytes_ == size_; }
  [[nodiscard]] std::uint64_t size() const noexcept { return size_; }
  [[nodiscard]] std::uint64_t freeBytes() const noexcept { return freeBytes_; }

 private:
  std::uint64_t size_;
  std::uint64_t freeBytes_;
  std::map<std::uint64_t, std::uint64_t> ranges_;  // offset -> size of each free range
};

}  // namespace luxo::gpu
