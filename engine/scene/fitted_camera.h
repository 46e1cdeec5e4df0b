// SPDX-License-Identifier: Apache-2.0
// A camera for a scene that names none: it shows what is really there, as large as it fits.
#pragma once

#include "scene/camera.h"
#include "scene/snapshot.h"

namespace luxo {

/// Where a fitted camera stands, from what it looks at.
inline constexpr Vec3 kFittedDirection{1, 0.8, 1.5};

/// From that direction, with a field of view of 40 degrees and +Y up: the points of the snapshot's surfaces
/// reach from edge to edge over 85 % of the picture's width or height, whichever they fill first, and have as
/// much room on the left as on the right, and above as below. What surfaces are found to be by sampling is
/// then proven, by interval bounds of ever smaller parts of them: they reach no farther than to 86 %, or,
/// where that takes too much work, not out of the picture; but where nearly all of a picture would be left
/// for what bounds do not exclude, nothing is proven. Of a surface that is unbounded or not defined
/// everywhere (Surface::framing) most is shown, and nothing proven. Nothing to see counts as the unit cube
/// around the origin. Cost: a millisecond for a surface, at most some ten for many or difficult ones.
[[nodiscard]] Camera fitCamera(const Snapshot& snapshot, PixelSize size,
                               const Vec3& direction = kFittedDirection);

/// Some finite points of a surface in object space, among them those of a grid of at most `perSide` x
/// `perSide` points on each patch that has them; those near a pole of its formula left out.
[[nodiscard]] std::vector<Vec3> pointsToSee(const SnapshotNode& node, int perSide);

}  // namespace luxo
