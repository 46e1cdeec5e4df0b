// SPDX-License-Identifier: Apache-2.0
// Numbers by their bits, compared and hashed: what tells -0 from 0, and takes a NaN for itself.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>

namespace luxo {

[[nodiscard]] inline bool sameBits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}
[[nodiscard]] inline bool sameBits(std::span<const double> a, std::span<const double> b) {
  return std::ranges::equal(a, b, [](double x, double y) { return sameBits(x, y); });
}

/// Mixes a word into a hash (the finalizer of MurmurHash3).
[[nodiscard]] constexpr std::uint64_t mixed(std::uint64_t hash, std::uint64_t word) {
  hash = (hash ^ word) * 0xff51afd7ed558ccdull;
  hash = (hash ^ (hash >> 33)) * 0xc4ceb9fe1a85ec53ull;
  return hash ^ (hash >> 33);
}
[[nodiscard]] inline std::uint64_t mixed(std::uint64_t hash, std::span<const double> numbers) {
  for (const double number : numbers) hash = mixed(hash, std::bit_cast<std::uint64_t>(number));
  return hash;
}

}  // namespace luxo
