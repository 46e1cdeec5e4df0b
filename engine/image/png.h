// SPDX-License-Identifier: Apache-2.0
// PNG (ISO/IEC 15948) to and from memory.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "image/codes.h"
#include "image/image.h"

namespace luxo {

/// 8-bit codes, RGB or (four channels) RGBA; one channel is written as grey RGB. Fast rather than small: SUB
/// filter and zlib level 1, about 15 ms for 1280 x 720. Chunks: IHDR, sRGB (not of
/// Codes::Data), IDAT, IEND; equal images give equal bytes.
[[nodiscard]] std::vector<std::byte> encodePng(const Image& image, Codes codes = Codes::Srgb);

/// Any PNG: grey gives one channel, colour three, transparency four; 8 and 16 bit are read as `codes` says
/// (gAMA and colour profiles are not applied) and given linear. `name` is for messages. Error(Scene):
/// damaged, or too large to be true.
[[nodiscard]] Image decodePng(std::span<const std::byte> bytes, std::string_view name,
                              Codes codes = Codes::Srgb);

}  // namespace luxo
