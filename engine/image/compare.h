// SPDX-License-Identifier: Apache-2.0
// How different two pictures are, as numbers and as a picture.
#pragma once

#include <cstddef>
#include <cstdint>

#include "image/image.h"

namespace luxo {

/// In which values samples are compared.
enum class ComparisonSpace {
  Linear,  ///< the floats as they are
  Srgb,    ///< clamped to 0..1 and sRGB-coded, not quantised; alpha stays linear
  Srgb8,   ///< after the 8-bit encode, code / 255: what two PNG files differ by
};

/// Differences of single samples, |a - b|. Equal infinities and two NaNs are equal; one NaN, or one infinity
/// against anything else, is an infinite difference.
struct Comparison {
  double max = 0;
  double mean = 0;
  double rmse = 0;
  double psnr = 0;  ///< dB for a peak of 1; +infinity when equal
  std::int64_t pixels = 0;
  std::int64_t differingPixels8 = 0;  ///< pixels with another 8-bit code in some channel
  std::int64_t nanSamples = 0;        ///< samples that are NaN in exactly one of the two
  int maxX = 0, maxY = 0;             ///< the first pixel, row by row, with the largest difference
};

/// Error(Requirement) when width, height or channels differ.
[[nodiscard]] Comparison compare(const Image& a, const Image& b,
                                 ComparisonSpace space = ComparisonSpace::Linear);

/// RGB: each pixel's largest sample difference on a ramp from dark violet through green to yellow, even in
/// perceived lightness; black where equal. `brightest` is the difference shown yellow; 0 takes the largest
/// finite one. Errors as compare.
[[nodiscard]] Image heatMap(const Image& a, const Image& b, ComparisonSpace space = ComparisonSpace::Linear,
                            double brightest = 0);

}  // namespace luxo
