// SPDX-License-Identifier: Apache-2.0
// What the readers and writers of this folder share: checked reading, little-endian numbers, one shape of
// error.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/printable.h"
#include "image/image.h"

namespace luxo {

[[noreturn]] inline void throwBadImage(std::string_view name, std::string_view format, std::string_view why) {
  throw Error(ErrorKind::Scene, fmt::format("cannot read '{}' as {}: {}", printable(name), format, why));
}

/// A damaged header must not ask for more memory than the largest picture luxo renders, 16384 x 16384.
inline constexpr double kMaxPixels = 16384.0 * 16384.0;

/// Refuses sizes that no honest file of this length can hold, before anything is allocated. `bytesPerPixel`
/// is the least that a pixel takes after the format's best compression.
inline void requirePlausibleSize(std::string_view name, std::string_view format, std::int64_t width,
                                 std::int64_t height, double bytesPerPixel, std::size_t bytes) {
  if (width < 1 || height < 1 || width > kMaxImageSide || height > kMaxImageSide)
    throwBadImage(name, format,
                  fmt::format("its size, {} x {}, is not within 1..{}", width, height, kMaxImageSide));
  if (double(width) * double(height) > kMaxPixels)
    throwBadImage(name, format, fmt::format("{} x {} pixels are more than luxo reads", width, height));
  if (double(width) * double(height) * bytesPerPixel > double(bytes))
    throwBadImage(
        name, format,
        fmt::format("{} x {} pixels cannot be in {} bytes; is the file cut short?", width, height, bytes));
}

/// deflate never packs better than 1032 to 1 (zlib's technical details).
inline constexpr double kBestDeflateRatio = 1032;

inline std::span<const std::byte> asBytes(std::string_view text) { return std::as_bytes(std::span(text)); }

inline void append(std::vector<std::byte>& out, std::span<const std::byte> bytes) {
  out.insert(out.end(), bytes.begin(), bytes.end());
}

}  // namespace luxo
