// SPDX-License-Identifier: Apache-2.0
#include "image/texture.h"

#include <algorithm>

#include "base/assert.h"
#include "fuzz/message.h"
#include "fuzz/target.h"

namespace luxo {

void fuzzTexture(std::string_view input) {
  const auto bytes = std::as_bytes(std::span(input));
  // Honest files of few bytes may be large pictures of one colour; what is looked at here is small ones.
  constexpr std::size_t kMaxBytes = 4096;
  if (bytes.size() > kMaxBytes) return;
  for (const Codes codes : {Codes::Srgb, Codes::Data}) {
    const auto texture = resultOf([&] { return decodeTexture(bytes, "fuzz", codes); });
    if (!texture) return;
    LUXO_REQUIRE(!texture->levels.empty());
    for (std::size_t i = 0; i < texture->levels.size(); ++i) {
      const TextureLevel& level = texture->levels[i];
      LUXO_REQUIRE_COMPARE(level.halves.size(), ==, 4 * std::size_t(level.width) * std::size_t(level.height));
      if (i > 0) {
        const int width = texture->levels[i - 1].width, height = texture->levels[i - 1].height;
        LUXO_REQUIRE(level.width == std::max(1, width / 2) && level.height == std::max(1, height / 2));
      }
      constexpr int kOne = 0x3c00;
      for (const int half : level.halves) LUXO_REQUIRE_COMPARE(half, <=, kOne);
    }
    LUXO_REQUIRE(texture->levels.back().width == 1 && texture->levels.back().height == 1);
  }
}

}  // namespace luxo
