// SPDX-License-Identifier: Apache-2.0
// What a light sees of what casts its shadow: the pictures of a depth map.
#pragma once

#include <vector>

#include "scene/snapshot.h"
#include "scene/view.h"

namespace luxo {

/// Square pictures with `size` texels along a side, which show all of `casters` that may stand before
/// `receivers` (both world, finite, not empty): one, as narrow as can be, of a directional light, and of a
/// point light that has all casters before it; else six, the faces of a cube. Depths from the nearest caster
/// on.
[[nodiscard]] std::vector<View> lightViews(const SnapshotLight& light, const Box& casters,
                                           const Box& receivers, int size);

/// Of a snapshot with such a light the scene as the light sees it: its casters alone, through the first of
/// its views. Throws Error(Scene) where no light has casters.
[[nodiscard]] Snapshot seenFromLight(Snapshot snapshot, int size);

}  // namespace luxo
