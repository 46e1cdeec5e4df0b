// SPDX-License-Identifier: Apache-2.0
// Leaves clusters of triangle meshes out of draws that do not need them (cull/clusters.h).
#pragma once

#include "draw/draw_list.h"

namespace luxo {

/// Of what is seen, not of what casts shadows. Instances of a mesh that need other clusters become draws of
/// their own.
void dropClusters(DrawList& list, const Snapshot& snapshot, const DrawOptions& options);

}  // namespace luxo
