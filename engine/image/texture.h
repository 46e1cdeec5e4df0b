// SPDX-License-Identifier: Apache-2.0
// Images as textures: linear half floats with their mip levels, as devices take them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "image/codes.h"
#include "image/image.h"

namespace luxo {

/// The longest side of a texture: what images of common devices hold.
inline constexpr int kMaxTextureSide = 16384;

/// RGBA, rows from the top, linear (alpha is not multiplied in): VK_FORMAT_R16G16B16A16_SFLOAT, which every
/// device filters. Each number is a half (image/half.h); of an 8-bit code it is off by at most 0.07 codes.
struct TextureLevel {
  int width = 0, height = 0;
  std::vector<std::uint16_t> halves;  ///< 4 * width * height

  /// What a device reads there, exactly.
  [[nodiscard]] std::array<float, 4> texel(int x, int y) const;
};

/// The image, and each level half as large as the one before, rounded down, to 1 x 1. A texel is the mean of
/// the part of the level before that it covers, in linear light, so that all levels have the same mean; sides
/// that are odd are cut within texels. Colours are weighed by their alpha: what is not seen gives no colour.
struct Texture {
  std::vector<TextureLevel> levels;
  bool transparent = false;  ///< some alpha is below 1
};

/// Of any image: one channel is grey, missing alpha 1. With Codes::Data alpha is a number as the others, and
/// weighs nothing. Cost: 11 bytes a texel, and 21 while it is made. Error(Scene): a side above
/// kMaxTextureSide.
[[nodiscard]] Texture makeTexture(const Image& image, std::string_view name, Codes codes = Codes::Srgb);

/// PNG, JPEG or TGA, told by its first bytes. Error(Scene): none of them, damaged, or too large.
[[nodiscard]] Texture decodeTexture(std::span<const std::byte> bytes, std::string_view name, Codes codes);
[[nodiscard]] Texture loadTexture(const std::filesystem::path& path, Codes codes);

}  // namespace luxo
