// SPDX-License-Identifier: Apache-2.0
#include "surface/spread.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/assert.h"

namespace luxo {
namespace {

double quantile(std::vector<double>& values, double part) {
  const auto place = static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, values.begin() + place);
  return values[static_cast<std::size_t>(place)];
}

}  // namespace

bool isFinite(const Vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

Spread spreadOf(std::span<const Vec3> points) {
  LUXO_REQUIRE(!points.empty());
  Spread spread;
  std::vector<double> values(points.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::ranges::transform(points, values.begin(), [&](const Vec3& p) { return p[axis]; });
    spread.center[axis] = quantile(values, 0.5);
  }
  std::ranges::transform(points, values.begin(),
                         [&](const Vec3& p) { return glm::length(p - spread.center); });
  spread.radius = quantile(values, 0.9);
  if (!(spread.radius > 0)) spread.radius = quantile(values, 1);
  return spread;
}

}  // namespace luxo
