// SPDX-License-Identifier: Apache-2.0
#include "base/printable.h"

#include "base/utf8.h"

namespace luxo {

std::string printable(std::string_view text) {
  std::string shown;
  for (std::size_t at = 0; at < text.size();) {
    const Utf8Character c = decodeUtf8(text, at);
    const bool isControl = c.point < 0x20 || (c.point >= 0x7f && c.point < 0xa0);
    if (c.valid && !isControl)
      shown += text.substr(at, c.bytes);
    else
      shown += '?';
    at += c.bytes;
  }
  return shown;
}

}  // namespace luxo
