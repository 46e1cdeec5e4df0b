// SPDX-License-Identifier: Apache-2.0
// What each pixel of a picture is off by, and what is wrong with it (verification.h), before it is summed up.
#pragma once

#include <cstdint>
#include <vector>

#include "reference/light_judge.h"
#include "reference/verification.h"

namespace luxo::reference {

inline constexpr double kUnset = -1;  ///< of errors: nothing was compared

/// One pixel's comparison; errors are kUnset where they do not apply.
struct JudgedPixel {
  Mismatch mismatch = Mismatch::None;
  bool compared = false, inside = false, differs8 = false, nan = false;
  bool byShader = false;  ///< its colour is a material's own shader's, of which there is no truth
  bool offPoint = false;  ///< wrong, unless near an outline
  LightVerdict light = LightVerdict::Right;
  float silhouettePx = 0;
  double position = kUnset, parameter = kUnset, point = kUnset, depth = kUnset, normal = kUnset,
         color = kUnset, squares = 0, codedSquares = 0;
};

/// The largest error of the rounded truth.
struct Floors {
  double position = 0, parameter = 0, point = 0, depth = 0, normal = 0;

  void add(const Floors& other) {
    position = std::max(position, other.position);
    parameter = std::max(parameter, other.parameter);
    point = std::max(point, other.point);
    depth = std::max(depth, other.depth);
    normal = std::max(normal, other.normal);
  }
};

struct JudgedPicture {
  std::vector<std::uint32_t> chosen;  ///< row * width + column of the pixels that were judged
  std::vector<JudgedPixel> pixels;    ///< as chosen
  Floors floors;
};

/// Cost: a microsecond a pixel, and some hundred rays where one is wrong. Throws Error(Requirement) where the
/// measured picture is not of the size of the truth.
[[nodiscard]] JudgedPicture judgePixels(const Snapshot& snapshot, const ReferencePicture& truth,
                                        const MeasuredPicture& measured, const VerificationOptions& options);

}  // namespace luxo::reference
