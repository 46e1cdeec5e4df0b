// SPDX-License-Identifier: Apache-2.0
// Leaves clusters of triangle meshes out of draws that do not need them (cull/clusters.h).
#pragma once

#include <cstdint>
#include <span>

#include "draw/draw_list.h"

namespace luxo {

/// Of what is seen, not of what casts shadows. Instances of a mesh that need other clusters become draws of
/// their own. The clusters that one needs are put together in DrawList::clusterIndices, as each stretch of a
/// mesh's own indices would be a draw, which costs a CPU device as much as a cluster.
/// `solids`: indices into Snapshot::nodes of meshes that hide what is behind (ClusterCulling::occlude()).
void dropClusters(DrawList& list, const Snapshot& snapshot, std::span<const std::uint32_t> solids,
                  const DrawOptions& options, MeshCache& meshes);

}  // namespace luxo
