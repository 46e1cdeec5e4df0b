// SPDX-License-Identifier: Apache-2.0
// Lines on a surface where formulas take given values: level lines, contours, the grid of u and v; as wide as
// is said in pixels, whatever the distance, and antialiased exactly. shaders/lib/isolines.glsl has the same
// in float.
//
// Within a pixel a field h(u, v) is taken for linear. How it moves from pixel to pixel is its derivative,
// exact, times the pixel's footprint; a line of level c is then a straight band, whose width is in pixels,
// and what counts is the area of it within the square that the pixel is. So the sum over pixels of what a
// line covers is its area, wherever it lies. Lines that are nearer to each other than their width cover all;
// of more than four in a pixel the mean is shown: they make no moire.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "formula/expression.h"
#include "math/vec.h"

namespace luxo {

/// Where a field is `at` + k `step` for a whole number k, or without a step where it is `at`; `step` is not
/// 0. No line is where the field or its slope has no value, or where float's rounding hides the slope; by a
/// pole that grows: the curvature of a ball, 1, may be a speck there, of lines that have 1 among their
/// values.
struct LineFamily {
  Expr of, at;
  std::optional<Expr> step;
};

/// Families of lines that look alike: where they cross they are no darker.
struct Isolines {
  std::vector<LineFamily> families;
  Expr width;                 ///< pixels
  std::array<Expr, 3> color;  ///< linear RGB; light falls on it as on the surface's own
  Expr opacity;               ///< from 0 to 1
};

inline constexpr std::size_t kMaxLineFamilies = 8;  // of one material

/// Of a field in float, relative.
inline constexpr double kFieldRounding = 1e-6;
/// Steps a pixel from which on there are lines everywhere, or, of a single one, nowhere.
inline constexpr double kEndlessSlope = 1e30;
/// In a pixel: between, what is shown goes over to the mean.
inline constexpr double kFewLines = 3, kManyLines = 4;

/// A field at one point, in units of the step.
struct LineField {
  double level = 0;     ///< distance from `at`
  Vec2 gradient{0};     ///< by u and v
  double size = 0;      ///< of the field itself: its rounding is proportional to that
  bool repeats = true;  ///< whether there is a step
};

/// The part of a pixel, 0 to 1, that lines `width` pixels wide cover, where the field moves by `perPixel` to
/// the pixel at the right and to that below. 0 where that is not finite.
[[nodiscard]] double lineCoverage(const LineField& field, const Vec2& perPixel, double width);

}  // namespace luxo
