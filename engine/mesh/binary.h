// SPDX-License-Identifier: Apache-2.0
// Numbers of binary files.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string_view>

#include "base/assert.h"

namespace luxo {

/// The number whose bytes begin at `at`; all must be there.
template <class T>
[[nodiscard]] T readNumber(std::string_view bytes, std::size_t at, std::endian order) {
  LUXO_REQUIRE(at <= bytes.size() && sizeof(T) <= bytes.size() - at);
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), bytes.data() + at, sizeof(T));
  if (order != std::endian::native) std::reverse(raw.begin(), raw.end());
  return std::bit_cast<T>(raw);
}

}  // namespace luxo
