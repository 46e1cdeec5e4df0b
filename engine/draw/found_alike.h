// SPDX-License-Identifier: Apache-2.0
// Whether two pictures differ in the light on what they find alone: then it is not found again.
#pragma once

#include "draw/draw_list.h"

namespace luxo {

/// Whether all that the passes of `last` have found, points and the shadows on them, is to the bit what those
/// of `next` would find, and is still in the targets when they are done: of deferred lists whose lights'
/// groups leave each other's shadows alone, with nothing that is seen through, or asks rays, or is drawn over
/// what is found. What may differ is what lights it: materials, their patterns and textures. May say no where
/// it is so. Cost: reads both lists.
[[nodiscard]] bool findsAlike(const DrawList& last, const DrawList& next);

}  // namespace luxo
