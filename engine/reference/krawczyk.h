// SPDX-License-Identifier: Apache-2.0
// Numbers with a radius, and the test that proves two equations in (u,v) to have one solution in a rectangle,
// or none (R. Krawczyk 1969).
#pragma once

#include <cmath>
#include <optional>

#include "reference/cell_tree.h"

namespace luxo::reference {

/// A number and how far it may be from the true one.
struct Ball {
  double center = 0, radius = 0;

  [[nodiscard]] double lo() const { return center - radius; }
  [[nodiscard]] double hi() const { return center + radius; }
  [[nodiscard]] double magnitude() const { return std::abs(center) + radius; }
};

/// a . p + offset over everything p may be, rounding included.
[[nodiscard]] inline Ball value(const Vec3& a, const Enclosure& p, double offset) {
  const Vec3 size = glm::abs(a) * glm::abs(p.center);
  return {glm::dot(a, p.center) + offset, glm::dot(glm::abs(a), p.radius) * (1 + 8 * kEpsilon) +
                                              4 * kEpsilon * (size.x + size.y + size.z + std::abs(offset))};
}

/// How f1 (first letter u) and f2 (v) change with u and v (second letter), over a rectangle.
struct Slopes {
  Ball uu, uv, vu, vv;

  [[nodiscard]] double determinant() const { return uu.center * vv.center - uv.center * vu.center; }
};

/// All solutions of f1 = f2 = 0 in a rectangle are within `radius` of its middle plus `step`.
struct Solutions {
  double stepU = 0, stepV = 0, radiusU = 0, radiusV = 0;

  [[nodiscard]] bool outside(double halfU, double halfV) const {
    return std::abs(stepU) - radiusU > halfU || std::abs(stepV) - radiusV > halfV;
  }
  /// Then there is exactly one, and all slopes in the balls have the sign of `determinant()`.
  [[nodiscard]] bool inside(double halfU, double halfV) const {
    return std::abs(stepU) + radiusU < halfU && std::abs(stepV) + radiusV < halfV;
  }
};

/// Of a rectangle of half sides `halfU` and `halfV`, with the values of f1 and f2 in its middle. Where these
/// or the slopes depend on something else within their balls, what it says holds for every value of that.
/// Nothing where the middle slopes are singular.
[[nodiscard]] std::optional<Solutions> krawczyk(const Slopes& slopes, const Ball& f1, const Ball& f2,
                                                double halfU, double halfV);

}  // namespace luxo::reference
