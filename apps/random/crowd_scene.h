// SPDX-License-Identifier: Apache-2.0
// Crowds: three to twelve named surfaces of the catalogue, mostly over a floor, in the exact shadows of one
// to four lights: points far, near and inside of them, directions, light that grazes the floor, soft ones;
// some of them cast by some alone, some seen through.
#pragma once

#include "random/hard_scene.h"

namespace luxo::random {

/// What `kind` calls them: they are no kind of surface, and take no turns with those.
inline constexpr std::string_view kCrowd = "crowd";

/// A pure function of seed and index. Cost: milliseconds.
[[nodiscard]] HardScene crowdScene(std::uint64_t seed, std::uint64_t index, const HardSceneOptions& options);

}  // namespace luxo::random
