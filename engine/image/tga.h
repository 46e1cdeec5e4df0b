// SPDX-License-Identifier: Apache-2.0
// Truevision TGA to and from memory.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "image/codes.h"
#include "image/image.h"

namespace luxo {

/// 8-bit sRGB, uncompressed, top row first: 24 bit, or 32 bit for four channels; one channel is written as
/// grey.
[[nodiscard]] std::vector<std::byte> encodeTga(const Image& image);

/// Whether the bytes may be a TGA, which has no mark of its own: they begin with a header that one could
/// have, of a kind that is read or not.
[[nodiscard]] bool mayBeTga(std::span<const std::byte> bytes);

/// Grey (8 bit: one channel) or true colour (24, 32 bit: three or four channels), uncompressed or run-length
/// encoded, in any of the four orders of rows and columns; read as `codes` says and given linear. `name`
/// is for messages. Error(Scene): damaged, or a kind not named here (palettes, 15 and 16 bit).
[[nodiscard]] Image decodeTga(std::span<const std::byte> bytes, std::string_view name,
                              Codes codes = Codes::Srgb);

}  // namespace luxo
