// SPDX-License-Identifier: Apache-2.0
// How far a point of the picture plane is from where a condition holds, when the condition can only be tried.
#pragma once

#include <functional>
#include <vector>

#include "math/vec.h"

namespace luxo::reference {

/// The distance from `center` to the nearest point where `holds`: points are tried on growing circles, then
/// the border is bisected along the nearest directions. Never below the true distance, and above it by less
/// than 1e-4 or 1 % whichever is more where the border is smooth at the scale of its distance; `farthest`
/// where nothing is found. Same units throughout. Cost: up to 300 tries.
[[nodiscard]] double distanceTo(const std::function<bool(const Vec2&)>& holds, const Vec2& center,
                                double farthest);

/// Places that tell what is within `farthest` of a center, the nearest ones first: 16 on each of five rings,
/// of which every other one is turned by half a step; the last is as much wider as a straight border that
/// touches the circle passes beside them. `coarse`: four, on one ring.
[[nodiscard]] std::vector<Vec2> placesAround(const Vec2& center, double farthest, bool coarse = false);

}  // namespace luxo::reference
