// SPDX-License-Identifier: Apache-2.0
// FLIP: the difference that a person sees who flips between two pictures, 0 (none) to 1, per pixel.
// P. Andersson, J. Nilsson, T. Akenine-Moeller, M. Oskarsson, K. Astroem, M. D. Fairchild, "FLIP: A
// Difference Evaluator for Alternating Images", HPG 2020: contrast sensitivity filters in an opponent colour
// space, the HyAB distance in Hunt-adjusted L*a*b*, and edges and points that are in one picture only.
#pragma once

#include "image/image.h"

namespace luxo {

struct FlipOptions {
  /// Pixels per degree of the visual angle: 67.02 for a screen of 3840 pixels over 0.7 m, seen from 0.7 m.
  double pixelsPerDegree = 67.02064327658226;
};

struct Flip {
  Image map;  ///< one channel: the difference per pixel
  double mean = 0, max = 0;
  double p999 = 0;  ///< 99.9 % of the pixels differ less
};

/// Of two scene-linear pictures shown clamped to 0..1; alpha does not count. NaN counts as black. Error
/// (Requirement) when their sizes or channels differ. Cost: separable filters, about 1 microsecond per pixel.
[[nodiscard]] Flip flip(const Image& reference, const Image& test, const FlipOptions& options = {});

}  // namespace luxo
