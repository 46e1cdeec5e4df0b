// SPDX-License-Identifier: Apache-2.0
// What the cases count in pictures.
#pragma once

#include <cstdint>

#include "image/image.h"
#include "math/vec.h"

namespace luxo {

/// Pixels that differ in any bit. Pictures of different sizes: all of the first.
[[nodiscard]] std::int64_t differingPixels(const Image& a, const Image& b);

/// The largest difference of two 8-bit codes in a pixel.
[[nodiscard]] int codeDifference(const Image& a, const Image& b, int x, int y);
/// The same of two linear colours.
[[nodiscard]] int codeDifference(const Vec3& a, const Vec3& b);

/// Samples that are no number or infinite.
[[nodiscard]] std::int64_t samplesNotFinite(const Image& image);

[[nodiscard]] Vec3 colorAt(const Image& image, int x, int y);
[[nodiscard]] Image flippedLeftRight(const Image& image);

}  // namespace luxo
