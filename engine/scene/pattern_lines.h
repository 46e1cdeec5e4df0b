// SPDX-License-Identifier: Apache-2.0
// The lines of a pattern, compiled: for the reference in double, and as GLSL.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "formula/expression.h"
#include "formula/tape.h"
#include "math/mat2.h"
#include "math/vec.h"
#include "scene/isolines.h"

namespace luxo {

/// What lines that look alike do to a pixel.
struct LinesOfPixel {
  Vec3 color{0};       ///< as its formulas give it
  double covered = 0;  ///< how much of the pixel is theirs: 0 to 1, their opacity included
};

class PatternLines {
 public:
  PatternLines() = default;  ///< none
  /// Over that color. Cost: that of both derivatives of each field. Throws as Pattern does.
  PatternLines(Graph& graph, const std::array<Expr, 3>& color, std::span<const Isolines> lines);

  [[nodiscard]] bool any() const { return !repeats_.empty(); }
  /// Empty without lines.
  [[nodiscard]] const std::string& glsl() const { return glsl_; }
  /// One for each of the lines that look alike.
  [[nodiscard]] std::vector<LinesOfPixel> at(double u, double v, const Mat2& footprint,
                                             std::span<const double> parameters) const;

 private:
  std::vector<std::vector<bool>> repeats_;  ///< of each of their families
  std::string glsl_;
  Tape tape_;
};

}  // namespace luxo
