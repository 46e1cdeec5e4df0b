// SPDX-License-Identifier: Apache-2.0
#include "gpu/free_list.h"

#include "base/assert.h"

#include <bit>
#include <iterator>

namespace luxo::gpu {

FreeList::FreeList(std::uint64_t size) : size_(size), freeBytes_(size), ranges_{{0, size}} {
  LUXO_REQUIRE_COMPARE(size, >, 0u);
}

std::optional<std::uint64_t> FreeList::allocate(std::uint64_t size, std::uint64_t alignment) {
  LUXO_REQUIRE_COMPARE(size, >, 0u);
  LUXO_REQUIRE(std::has_single_bit(alignment));
  for (auto range = ranges_.begin(); range != ranges_.end(); ++range) {
    const auto [begin, length] = *range;
    const std::uint64_t padding = (alignment - begin % alignment) % alignment;
    if (length < padding || length - padding < size) continue;
    const std::uint64_t rest = length - padding - size;
    // The padding stays free, so that freeing needs no more than what was asked for.
    if (padding > 0) {
      range->second = padding;
    } else {
      ranges_.erase(range);
    }
    if (rest > 0) ranges_.emplace(begin + padding + size, rest);
    freeBytes_ -= size;
    return begin + padding;
  }
  return std::nullopt;
}

void FreeList::free(std::uint64_t offset, std::uint64_t size) {
  LUXO_REQUIRE_COMPARE(size, >, 0u);
  LUXO_REQUIRE_COMPARE(offset + size, <=, size_);
  const auto next = ranges_.lower_bound(offset);
  const auto previous = next == ranges_.begin() ? ranges_.end() : std::prev(next);
  if (next != ranges_.end()) LUXO_REQUIRE_COMPARE(offset + size, <=, next->first);
  if (previous != ranges_.end()) LUXO_REQUIRE_COMPARE(previous->first + previous->second, <=, offset);
  freeBytes_ += size;

  if (next != ranges_.end() && next->first == offset + size) {
    size += next->second;
    ranges_.erase(next);
  }
  if (previous != ranges_.end() && previous->first + previous->second == offset) {
    previous->second += size;
  } else {
    ranges_.emplace(offset, size);
  }
}

}  // namespace luxo::gpu
