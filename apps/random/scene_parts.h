// SPDX-License-Identifier: Apache-2.0
// What random scenes of all sorts are put together from.
#pragma once

#include <cstdint>
#include <utility>

#include "random/hard_scene.h"
#include "random/numbers.h"

namespace luxo::random {

[[nodiscard]] inline Json vectorJson(double x, double y, double z) {
  return Json::array({rounded(x), rounded(y), rounded(z)});
}

/// Any rotation.
[[nodiscard]] Json turned(Numbers& n);

/// Of some scenes; from numbers of its own, so that all else of them is what it was before.
[[nodiscard]] bool showsFrontOnly(std::uint64_t seed, std::uint64_t index);

/// Size and samples of a picture.
[[nodiscard]] std::pair<PixelSize, int> formatOf(const HardSceneOptions& options, Numbers& n);

}  // namespace luxo::random
