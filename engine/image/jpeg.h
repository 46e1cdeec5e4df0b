// SPDX-License-Identifier: Apache-2.0
// JPEG (ITU-T T.81) from memory, by libjpeg-turbo.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "image/codes.h"
#include "image/image.h"

namespace luxo {

/// Grey (one channel) or colour (three), baseline or progressive, read as `codes` says and given linear.
/// `name` is for messages. Error(Scene): damaged or cut short, too large to be true, or of four inks.
[[nodiscard]] Image decodeJpeg(std::span<const std::byte> bytes, std::string_view name,
                               Codes codes = Codes::Srgb);

}  // namespace luxo
