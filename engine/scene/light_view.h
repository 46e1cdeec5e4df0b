// SPDX-License-Identifier: Apache-2.0
// What a light sees of what casts its shadow: the pictures of a depth map.
#pragma once

#include <optional>
#include <vector>

#include "scene/snapshot.h"
#include "scene/view.h"

namespace luxo {

/// `light`: w = 1: where it is; w = 0: the direction toward it. A point so far from `all` (world) that
/// between points of that box its rays are less than `most` of the box's size from parallel ones: the
/// direction toward it, of which floats keep what they lose of the point. Else the light as it is.
[[nodiscard]] Vec4 parallelWhereFar(const Vec4& light, const Box& all, double most);

/// The light as a depth map of `size` texels along a side has it: a direction where from all of `receivers`
/// parallel rays stay within a quarter of a texel, with the angle as its map's radius. Boxes: world, finite,
/// not empty.
[[nodiscard]] SnapshotLight asMapped(SnapshotLight light, const Box& casters, const Box& receivers, int size);

/// Square pictures with `size` texels along a side, which show all of `casters` that may stand before
/// `receivers` (both world, finite, not empty): one, as narrow as can be, of a directional light, of a point
/// light that has all casters before it, and of a spot whose cone is within 63 degrees of its axis, of what
/// is in that; else six, the faces of a cube. Depths from the nearest caster on.
[[nodiscard]] std::vector<View> lightViews(const SnapshotLight& light, const Box& casters,
                                           const Box& receivers, int size);

/// The scene as a node's light that has a shadow sees it, without one the first of the scene: its casters
/// alone, of a map those it has, in one picture, which of a light amid them shows what is within 63 degrees
/// of their middle, or of a spot its cone. Depths are distances along the view from a point light, up to 2^30
/// times the casters' size away; else from the nearest caster's. Pixels along a side as given; else those of
/// its map, or as many as fit into the snapshot's picture. Throws Error(Scene) where no light has a shadow,
/// or not that one.
[[nodiscard]] Snapshot seenFromLight(Snapshot snapshot, std::optional<int> size = std::nullopt,
                                     NodeId light = {});

}  // namespace luxo
