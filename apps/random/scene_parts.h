// SPDX-License-Identifier: Apache-2.0
// What random scenes of all sorts are put together from.
#pragma once

#include <utility>

#include "random/hard_scene.h"
#include "random/numbers.h"

namespace luxo::random {

[[nodiscard]] inline Json vectorJson(double x, double y, double z) {
  return Json::array({rounded(x), rounded(y), rounded(z)});
}

/// Any rotation.
[[nodiscard]] Json turned(Numbers& n);

/// Size and samples of a picture.
[[nodiscard]] std::pair<PixelSize, int> formatOf(const HardSceneOptions& options, Numbers& n);

}  // namespace luxo::random
