// SPDX-License-Identifier: Apache-2.0
// Where single precision would move triangles in the picture.
#pragma once

#include <vector>

#include "cull/cull.h"
#include "draw/pixel_rows.h"
#include "scene/snapshot.h"

namespace luxo {

/// Appends rectangles that hold every pixel in which what float rounds away of corners may move the node's
/// triangles by half of what an outline may be off (0.01 px): those with a corner so much farther from the
/// eye than they are (vertexMiddle()), of parallel rays all or none. `origin`: shadingOrigin();
/// `vertexOrigin`: what the drawn vertices are relative to; where it is not the triangles' own, they were
/// rounded once more. Cost: nothing where all is far enough, else some 100 ns for each cluster and 100 ns for
/// each triangle of those that are too near.
void appendBlurred(const View& view, const SnapshotNode& node, const VisibleNode& visible, const Vec3& origin,
                   const Vec3& vertexOrigin, std::vector<PixelRect>& rects);

}  // namespace luxo
