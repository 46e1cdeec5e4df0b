// SPDX-License-Identifier: Apache-2.0
// What shaders know of a view and of its instances (shared/scene_data.h).
#pragma once

#include "cull/cull.h"
#include "scene/snapshot.h"
#include "shared/scene_data.h"

namespace luxo {

[[nodiscard]] shared::ViewData viewData(const Snapshot& snapshot, const VisibleList& visible);

/// All but its material. `origin`: of the vertices, object space. `showsBack`: not only the outer side is
/// seen.
[[nodiscard]] shared::InstanceData instanceData(const Snapshot& snapshot, const SnapshotNode& node,
                                                const VisibleNode& visible, const Vec3& origin,
                                                bool showsBack);

}  // namespace luxo
