// SPDX-License-Identifier: Apache-2.0
// One character at a time out of UTF-8 text that may be anything.
#pragma once

#include <cstddef>
#include <string_view>

namespace luxo {

/// A character and the bytes it takes. Bytes that are no UTF-8 (overlong, surrogate, beyond U+10FFFF or cut
/// off) come as one character each, U+FFFD, not valid.
struct Utf8Character {
  char32_t point = 0xfffd;
  std::size_t bytes = 1;
  bool valid = false;
};

/// The character that starts at byte `at` (< text.size()).
[[nodiscard]] constexpr Utf8Character decodeUtf8(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned lead = byte(at);
  if (lead < 0x80) return {lead, 1, true};
  const std::size_t length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc2 || lead > 0xf4 || length > text.size() - at) return {};
  char32_t point = lead & (0x7fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(at + i) & 0xc0) != 0x80) return {};
    point = point << 6 | (byte(at + i) & 0x3f);
  }
  const bool overlong = (length == 3 && point < 0x800) || (length == 4 && point < 0x10000);
  if (overlong || point > 0x10ffff || (point >= 0xd800 && point < 0xe000)) return {};
  return {point, length, true};
}

}  // namespace luxo
