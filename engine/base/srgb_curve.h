// SPDX-License-Identifier: Apache-2.0
// The sRGB curve (IEC 61966-2-1): how linear light is written where people and files mean sRGB.
#pragma once

namespace luxo {

/// Of a linear value in 0..1, in double.
[[nodiscard]] double srgbFromLinear(double linear);

/// The inverse, of an encoded value in 0..1, in double.
[[nodiscard]] double linearFromSrgb(double encoded);

}  // namespace luxo
