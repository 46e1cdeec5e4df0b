// SPDX-License-Identifier: Apache-2.0
// Cameras that are hard to look through, about the surfaces of any scene: from far and near, from inside,
// along a surface, through it, with fields of view of thousandths to 170 degrees, and of parallel rays.
#pragma once

#include <string>

#include "random/hard_surface.h"
#include "scene/snapshot.h"

namespace luxo::random {

struct HardCamera {
  std::string kind;
  Json json;  ///< a scene file's `camera`; constant numbers, angles in radians
};

/// For the surfaces of a snapshot, whose own camera does not matter. It has something in its picture, most
/// often: of ten tries the first that shows one of some hundred points of the surfaces, unless others hide
/// it.
[[nodiscard]] HardCamera hardCamera(const Snapshot& snapshot, Numbers& numbers);

/// The camera that such a description means.
[[nodiscard]] Camera cameraOf(const Json& json);

}  // namespace luxo::random
