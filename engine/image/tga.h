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

/// Grey (8 bit: one channel), true colour (15, 16, 24, 32 bit: three or four channels) or a palette of such
/// colours (numbers of 8 or 16 bits), uncompressed or run-length encoded, in any of the four orders of rows
/// and columns; read as `codes` says and given linear. A channel of 5 bits is n / 31, one of 8 n / 255. There
/// is an alpha where the header promises one, of 1 bit (of 16) or of 8 (of 32). `name` is for messages.
/// Error(Scene): damaged, a number beyond the palette, or a kind not named here.
[[nodiscard]] Image decodeTga(std::span<const std::byte> bytes, std::string_view name,
                              Codes codes = Codes::Srgb);

}  // namespace luxo
