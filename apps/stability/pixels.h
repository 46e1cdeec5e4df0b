// SPDX-License-Identifier: Apache-2.0
// What the cases count in pictures.
#pragma once

#include <cstdint>

#include "image/image.h"
#include "math/vec.h"
#include "reference/caster.h"

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

/// Whether the true picture changes by more than one code within `radius` pixels of a pixel's centre: a
/// silhouette, a contour, or the border of a highlight that the horizon cuts off.
[[nodiscard]] bool nearEdge(const reference::Caster& caster, int x, int y, double radius);

}  // namespace luxo
