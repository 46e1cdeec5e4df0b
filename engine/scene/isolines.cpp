// SPDX-License-Identifier: Apache-2.0
#include "scene/isolines.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace luxo {
namespace {

/// The part of a square pixel in which a linear function is less than x, less a half, where it is 0 in the
/// middle and moves by a and b, a >= b >= 0, along the sides: the integral of a trapezoid.
double partBelow(double x, double a, double b) {
  const double off = std::abs(x), beyond = 0.5 * (a + b) - off;
  const double part = off <= 0.5 * (a - b) ? off / a : beyond > 0 ? 0.5 - beyond * beyond / (2 * a * b) : 0.5;
  return std::copysign(part, x);
}

}  // namespace

double lineCoverage(const LineField& field, const Vec2& perPixel, double width) {
  double a = std::abs(perPixel.x), b = std::abs(perPixel.y);
  if (a < b) std::swap(a, b);
  const double slope = std::sqrt(a * a + b * b);
  if (!(slope > kFieldRounding * field.size) || !(width > 0)) return 0;
  if (!(slope < kEndlessSlope)) return field.repeats ? 1 : 0;
  const double half = 0.5 * width * slope;  // of a line, in steps
  const auto covered = [&](double off) { return partBelow(off + half, a, b) - partBelow(off - half, a, b); };
  if (!field.repeats) return covered(field.level);
  const double mean = std::min(2 * half, 1.0),
               many = std::clamp(a + b - kFewLines, 0.0, kManyLines - kFewLines);
  if (mean == 1 || many == 1) return mean;
  const double off = field.level - std::floor(field.level);
  double sum = 0;
  for (int k = -2; k <= 3; ++k) sum += covered(off - k);
  return sum + many * (mean - sum);
}

}  // namespace luxo
