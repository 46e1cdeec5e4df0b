// SPDX-License-Identifier: Apache-2.0
// The one place where linear light becomes 8-bit sRGB and back; the curve itself is base/srgb_curve.h.
#pragma once

#include <cstdint>
#include <span>

#include "base/srgb_curve.h"

namespace luxo {

/// floor(255 * sRGB(clamp(linear, 0, 1)) + 0.5), the same as evaluating that in double for every float; NaN
/// gives 0. About 1 ns: one table look-up and one comparison.
[[nodiscard]] std::uint8_t encodeSrgb8(float linear);

/// The linear value of an 8-bit code; encodeSrgb8 of it gives the code back.
[[nodiscard]] float decodeSrgb8(std::uint8_t code);

/// floor(255 * clamp(alpha, 0, 1) + 0.5), in double; NaN gives 0. Alpha stays linear.
[[nodiscard]] std::uint8_t encodeAlpha8(float alpha);

/// Encodes samples of `channels` (1, 3 or 4) interleaved channels; the fourth is alpha. Sizes must agree.
void encodeSrgb8(std::span<const float> linear, int channels, std::span<std::uint8_t> codes);

/// The 8-bit pixels that a picture file holds: RGB, or RGBA for four channels; one channel is repeated three
/// times. `codes` needs 3 or 4 bytes for each pixel of the row.
void encodePixels8(std::span<const float> row, int channels, std::span<std::uint8_t> codes);

}  // namespace luxo
