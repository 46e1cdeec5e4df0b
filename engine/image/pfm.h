// SPDX-License-Identifier: Apache-2.0
// Portable float map to and from memory: raw linear float32, every bit kept, infinities and NaN included.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "image/image.h"

namespace luxo {

/// `PF` (three channels) or `Pf` (one), scale -1.0 (little endian), rows from bottom to top.
/// Error(Usage): four channels, as the format has no alpha.
[[nodiscard]] std::vector<std::byte> encodePfm(const Image& image);

/// Either byte order; the magnitude of the scale is a unit and is not applied. `name` is for messages.
/// Error(Scene): damaged.
[[nodiscard]] Image decodePfm(std::span<const std::byte> bytes, std::string_view name);

}  // namespace luxo
