// SPDX-License-Identifier: Apache-2.0
// Which of many records are equal, bit for bit.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "math/bits.h"
#include "math/vec.h"

namespace luxo {

[[nodiscard]] inline std::uint64_t mixed(std::uint64_t hash, const Vec3f& v) {
  hash =
      mixed(hash, std::uint64_t(std::bit_cast<std::uint32_t>(v.x)) << 32 | std::bit_cast<std::uint32_t>(v.y));
  return mixed(hash, std::bit_cast<std::uint32_t>(v.z));
}
[[nodiscard]] inline std::uint64_t mixed(std::uint64_t hash, const Vec2f& v) {
  return mixed(hash,
               std::uint64_t(std::bit_cast<std::uint32_t>(v.x)) << 32 | std::bit_cast<std::uint32_t>(v.y));
}

/// Records by their numbers, which the caller keeps: a table of open addresses, doubled when half full.
template <class Hash, class Equal>
class WeldingTable {
 public:
  /// hash(i), equal(i, j).
  WeldingTable(Hash hash, Equal equal) : slots_(64, kFree), hash_(hash), equal_(equal) {}

  /// The number of the record that came first of those equal to record i, which is i where there was none.
  [[nodiscard]] std::uint32_t firstEqual(std::uint32_t i) {
    std::uint32_t& slot = slotOf(i);
    if (slot != kFree) return slot;
    slot = i;
    if (2 * ++count_ > slots_.size()) grow();
    return i;
  }

 private:
  static constexpr std::uint32_t kFree = 0xffffffff;

  std::uint32_t& slotOf(std::uint32_t i) {
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = hash_(i) & mask;
    while (slots_[slot] != kFree && !equal_(slots_[slot], i)) slot = (slot + 1) & mask;
    return slots_[slot];
  }
  void grow() {
    std::vector<std::uint32_t> old(2 * slots_.size(), kFree);
    old.swap(slots_);
    const std::size_t mask = slots_.size() - 1;
    for (const std::uint32_t i : old) {
      if (i == kFree) continue;
      std::size_t slot = hash_(i) & mask;
      while (slots_[slot] != kFree) slot = (slot + 1) & mask;  // they all differ
      slots_[slot] = i;
    }
  }

  std::vector<std::uint32_t> slots_;
  std::size_t count_ = 0;
  Hash hash_;
  Equal equal_;
};

/// Points that differ, bit for bit, as they come.
class WeldedPoints {
 public:
  WeldedPoints() = default;
  WeldedPoints(const WeldedPoints&) = delete;  // its table asks it
  WeldedPoints& operator=(const WeldedPoints&) = delete;

  [[nodiscard]] std::uint32_t numberOf(const Vec3& point) {
    const auto last = std::uint32_t(points_.size());
    points_.push_back(point);
    const std::uint32_t number = table_.firstEqual(last);
    if (number != last) points_.pop_back();
    return number;
  }
  [[nodiscard]] std::vector<Vec3> take() { return std::move(points_); }

 private:
  [[nodiscard]] std::span<const double> numbers(std::uint32_t i) const { return {&points_[i].x, 3}; }

  struct Hash {
    const WeldedPoints& welded;
    std::uint64_t operator()(std::uint32_t i) const { return mixed(0, welded.numbers(i)); }
  };
  struct Equal {
    const WeldedPoints& welded;
    bool operator()(std::uint32_t i, std::uint32_t j) const {
      return sameBits(welded.numbers(i), welded.numbers(j));
    }
  };

  std::vector<Vec3> points_;
  WeldingTable<Hash, Equal> table_{Hash{*this}, Equal{*this}};
};

}  // namespace luxo
