// SPDX-License-Identifier: Apache-2.0
// Whether two pictures differ in the light on what they find alone: then it is not found again.
#pragma once

#include "draw/draw_list.h"

namespace luxo {

/// Whether what the passes of a list find stays in the targets when they are done: of a deferred one whose
/// groups of lights leave each other's shadows alone (of what is seen through: with one group), and with
/// nothing that sends rays or is drawn over what is found.
[[nodiscard]] bool keepsWhatItFinds(const DrawList& list);

/// Whether two moments differ in what materials look like and in the background alone: what rays find, too,
/// is the same, with all that goes with a point of it.
[[nodiscard]] bool findsAlike(const Snapshot& last, const Snapshot& next);

/// Of two lists that keep what they find, of snapshots that find alike: whether the passes of `last` find, to
/// the bit, what those of `next` would. May say no where they do. Cost: reads both.
[[nodiscard]] bool findsAlike(const DrawList& last, const DrawList& next);

}  // namespace luxo
