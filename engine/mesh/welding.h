// SPDX-License-Identifier: Apache-2.0
// Which of many records are equal, bit for bit.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "math/vec.h"

namespace luxo {

/// Mixes a word into a hash (the finalizer of MurmurHash3).
[[nodiscard]] constexpr std::uint64_t mixed(std::uint64_t hash, std::uint64_t word) {
  hash = (hash ^ word) * 0xff51afd7ed558ccdull;
  hash = (hash ^ (hash >> 33)) * 0xc4ceb9fe1a85ec53ull;
  return hash ^ (hash >> 33);
}
[[nodiscard]] inline std::uint64_t mixed(std::uint64_t hash, const Vec3f& v) {
  hash =
      mixed(hash, std::uint64_t(std::bit_cast<std::uint32_t>(v.x)) << 32 | std::bit_cast<std::uint32_t>(v.y));
  return mixed(hash, std::bit_cast<std::uint32_t>(v.z));
}
[[nodiscard]] inline std::uint64_t mixed(std::uint64_t hash, const Vec2f& v) {
  return mixed(hash,
               std::uint64_t(std::bit_cast<std::uint32_t>(v.x)) << 32 | std::bit_cast<std::uint32_t>(v.y));
}

/// Records by their numbers, which the caller keeps: a table of open addresses.
template <class Hash, class Equal>
class WeldingTable {
 public:
  /// For up to `count` different records; hash(i), equal(i, j).
  WeldingTable(std::size_t count, Hash hash, Equal equal)
      : slots_(std::bit_ceil(2 * count + 1), kFree), hash_(hash), equal_(equal) {}

  /// The number of the record that came first of those equal to record i, which is i where there was none.
  [[nodiscard]] std::uint32_t firstEqual(std::uint32_t i) {
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t slot = hash_(i) & mask;; slot = (slot + 1) & mask) {
      if (slots_[slot] == kFree) return slots_[slot] = i;
      if (equal_(slots_[slot], i)) return slots_[slot];
    }
  }

 private:
  static constexpr std::uint32_t kFree = 0xffffffff;
  std::vector<std::uint32_t> slots_;
  Hash hash_;
  Equal equal_;
};

}  // namespace luxo
