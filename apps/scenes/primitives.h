// SPDX-License-Identifier: Apache-2.0
// The named surfaces side by side: one picture to see them all by. Built-in scene `primitives`.
#pragma once

#include "scene/scene.h"

namespace luxo {

/// Eight surfaces in two rows on a floor, two lights, one still camera; the flag waves.
[[nodiscard]] Scene primitives();

}  // namespace luxo
