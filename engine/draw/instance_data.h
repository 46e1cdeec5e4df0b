// SPDX-License-Identifier: Apache-2.0
// What shaders know of a view and of its instances (shared/scene_data.h).
#pragma once

#include "cull/cull.h"
#include "scene/snapshot.h"
#include "shared/scene_data.h"

namespace luxo {

/// What positions in shaders are relative to: the eye, or the middle of all there is where the eye is farther
/// from that than kFarEye times its size. A float of a distance has 24 bits: of points 27 km away it would
/// leave 2 mm, and the light of a lamp beside them would be off by a hundredth.
[[nodiscard]] Vec3 shadingOrigin(const Snapshot& snapshot);
inline constexpr double kFarEye = 8;

[[nodiscard]] shared::ViewData viewData(const Snapshot& snapshot, const VisibleList& visible);

/// All but its material. `shadingOrigin`: shadingOrigin(), found once. `origin`: of the vertices, object
/// space. `showsBack`: not only the outer side is seen.
[[nodiscard]] shared::InstanceData instanceData(const Snapshot& snapshot, const SnapshotNode& node,
                                                const VisibleNode& visible, const Vec3& shadingOrigin,
                                                const Vec3& origin, bool showsBack);

}  // namespace luxo
