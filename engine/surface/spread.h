// SPDX-License-Identifier: Apache-2.0
// Where most points of a sampled surface lie: a few may be far out, near a pole of its formula.
#pragma once

#include <span>

#include "math/bounds.h"
#include "math/vec.h"

namespace luxo {

struct Spread {
  Vec3 center{0};     ///< median of each coordinate
  double radius = 0;  ///< from the centre; nine points of ten are within it (all, where that is 0)
};

/// Finite points, at least one. Cost: linear.
[[nodiscard]] Spread spreadOf(std::span<const Vec3> points);

[[nodiscard]] bool isFinite(const Vec3& p);
[[nodiscard]] inline bool isFinite(const Box& box) { return isFinite(box.min) && isFinite(box.max); }

}  // namespace luxo
