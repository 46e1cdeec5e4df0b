// SPDX-License-Identifier: Apache-2.0
#include "math/bounds.h"

#include "math/interval.h"

namespace luxo {

Sphere sphereAround(const Box& box) {
  if (box.empty()) return {};
  // Measured from the centre as it was rounded.
  const Vec3 center = box.center();
  const double radius = glm::length(glm::max(box.max - center, center - box.min)) * (1 + 1e-15);
  return radius < kInfinity ? Sphere{center, radius} : Sphere{Vec3(0), kInfinity};
}

Box transformBounds(const Transform& t, const Box& box) {
  if (box.empty()) return {};
  Box result;
  for (int row = 0; row < 3; ++row) {
    // In transformPoint()'s order of operations: so the box holds its rounded results, too.
    // Factors of 0 take no part, however large the box is.
    const auto term = [&](int column) {
      const double factor = t.linear[column][row];
      return factor == 0 ? Interval(0) : Interval(factor) * Interval(box.min[column], box.max[column]);
    };
    const Interval range = term(0) + term(1) + term(2) + Interval(t.translation[row]);
    result.min[row] = range.lo;
    result.max[row] = range.hi;
  }
  return result;
}

std::array<Vec3, 8> cornersOf(const Box& box) {
  std::array<Vec3, 8> corners;
  for (int i = 0; i < 8; ++i)
    corners[static_cast<std::size_t>(i)] = {(i & 1 ? box.max : box.min).x, (i & 2 ? box.max : box.min).y,
                                            (i & 4 ? box.max : box.min).z};
  return corners;
}

}  // namespace luxo
