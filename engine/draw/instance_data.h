// SPDX-License-Identifier: Apache-2.0
// What shaders know of a view and of its instances (shared/scene_data.h).
#pragma once

#include "cull/cull.h"
#include "scene/snapshot.h"
#include "shared/scene_data.h"

namespace luxo {

/// What positions in shaders are relative to: the eye, or where it is farther than kFarEye times their size
/// from all there is, or from what a narrow view shows, the middle of these. A float of a distance has 24
/// bits: of points 27 km away it would leave 2 mm, and the light of a lamp beside them would be off by a
/// hundredth; and where a pixel is 2e-5 of the distance, as through a telescope, a point would be off by a
/// hundredth of it. Cost: 10 ns for each node; of narrow views a microsecond for each that is seen.
[[nodiscard]] Vec3 shadingOrigin(const Snapshot& snapshot);
inline constexpr double kFarEye = 8;

/// `origin`: shadingOrigin().
[[nodiscard]] shared::ViewData viewData(const Snapshot& snapshot, const VisibleList& visible,
                                        const Vec3& origin);

/// What vertices are subtracted from before anything else is done to them, relative to their origin: of
/// triangles, which are floats themselves, about the point of object space that is at the shading origin. So
/// what floats round away of a vertex that is near to the eye is relative to its distance from there, not
/// from the object's middle. Else, and where nodes are sheared so much that this would be more, 0.
[[nodiscard]] Vec3f vertexMiddle(const SnapshotNode& node, const Vec3& shadingOrigin, const Vec3& origin);

/// All but its material. `shadingOrigin`: shadingOrigin(), found once. `origin`: of the vertices, object
/// space. `showsBack`: not only the outer side is seen.
[[nodiscard]] shared::InstanceData instanceData(const Snapshot& snapshot, const SnapshotNode& node,
                                                const VisibleNode& visible, const Vec3& shadingOrigin,
                                                const Vec3& origin, bool showsBack);

}  // namespace luxo
