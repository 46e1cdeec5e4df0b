// SPDX-License-Identifier: Apache-2.0
// Pictures to and from files; the suffix chooses the format, in either case: png, tga (8 bit, sRGB), exr, pfm
// (float, linear).
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "image/image.h"

namespace luxo {

enum class ImageFormat { Png, Tga, Pfm, Exr };

/// The format that the path's suffix names, if any.
[[nodiscard]] std::optional<ImageFormat> imageFormatOf(const std::filesystem::path& path);

/// The same; an unknown or missing suffix throws Error(Usage) that names the known ones.
[[nodiscard]] ImageFormat requireImageFormat(const std::filesystem::path& path);

/// True when the format holds 8-bit sRGB codes, false when it holds linear floats.
[[nodiscard]] bool storesSrgb8(ImageFormat format);

/// The bytes of the file. Equal images give equal bytes: no clock, no host, no random name is in them.
/// PFM has no alpha: four channels throw Error(Usage).
[[nodiscard]] std::vector<std::byte> encodeImage(const Image& image, ImageFormat format);

/// Writes the file whole or not at all. Error(Usage): unknown suffix; Error(Write): the file cannot be
/// written.
void saveImage(const Image& image, const std::filesystem::path& path);

/// Reads the file. Error(Usage): unknown suffix; Error(Scene): missing, unreadable or damaged file.
[[nodiscard]] Image loadImage(const std::filesystem::path& path);

}  // namespace luxo
