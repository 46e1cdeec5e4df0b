// SPDX-License-Identifier: Apache-2.0
// OpenEXR to and from memory: linear float32, every bit kept.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "image/image.h"

namespace luxo {

/// One scan-line part, float32, ZIP: channels R G B (A), or Y for one channel. Only the required attributes,
/// so equal images give equal bytes.
[[nodiscard]] std::vector<std::byte> encodeExr(const Image& image);

/// The channels R G B (A) of the first part, or its only channel; half and float, any compression, scan lines
/// or tiles. `name` is for messages. Error(Scene): damaged, too large to be true, or other channels.
[[nodiscard]] Image decodeExr(std::span<const std::byte> bytes, std::string_view name);

}  // namespace luxo
