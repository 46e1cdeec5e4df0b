// SPDX-License-Identifier: Apache-2.0
#include "draw/cluster_draws.h"

#include <utility>
#include <vector>

#include "surface/surface_triangles.h"

namespace luxo {
namespace {

/// Triangles of a mesh that cost less than to look at its clusters, and than draws of its instances.
constexpr std::uint32_t kFewTriangles = 8 * kClusterTriangles;

Faces facesOf(FaceCulling culling) {
  return culling == FaceCulling::None   ? Faces::Both
         : culling == FaceCulling::Back ? Faces::Front
                                        : Faces::Back;
}

class ClusterDraws {
 public:
  ClusterDraws(DrawList& list, const Snapshot& snapshot, const DrawOptions& options)
      : list_(list),
        snapshot_(snapshot),
        culling_(snapshot.view, {.frustum = options.skips.frustum, .backface = options.skips.backface}) {}

  void dropFrom(std::vector<DrawBatch>& batches) {
    std::vector<DrawBatch> kept;
    kept.reserve(batches.size());
    for (DrawBatch& batch : batches)
      if (hasClusters(batch))
        appendParts(kept, batch);
      else
        kept.push_back(std::move(batch));
    batches = std::move(kept);
  }

 private:
  [[nodiscard]] const SnapshotNode& nodeOf(std::uint32_t instance) const {
    return snapshot_.nodes[list_.instanceNodes[instance]];
  }

  /// A mesh that was clipped is not its surface's own.
  [[nodiscard]] bool hasClusters(const DrawBatch& batch) const {
    if (!batch.mesh || batch.indexCount <= 3 * kFewTriangles) return false;
    const SurfaceTriangles* triangles = nodeOf(batch.firstInstance).surface.triangles();
    return triangles && batch.indexCount == 3 * triangles->count;
  }

  void appendParts(std::vector<DrawBatch>& kept, const DrawBatch& batch) {
    const std::uint32_t end = batch.firstInstance + batch.instanceCount;
    const std::size_t before = kept.size();
    for (std::uint32_t i = batch.firstInstance; i < end; ++i) {
      const bool lines = batch.state.shading == Shading::Wireframe && !batch.state.hidesLines;
      std::vector<TriangleRange> parts =
          culling_.drawn(nodeOf(i), facesOf(batch.culling), lines, list_.clusters);
      if (parts.empty()) continue;
      const bool whole = parts == std::vector{TriangleRange{0, batch.indexCount / 3}};
      if (whole) parts.clear();
      const bool joins = kept.size() > before && kept.back().parts == parts &&
                         kept.back().firstInstance + kept.back().instanceCount == i;
      if (joins) {
        ++kept.back().instanceCount;
        continue;
      }
      DrawBatch& drawn = kept.emplace_back(batch);
      drawn.parts = std::move(parts);
      drawn.firstInstance = i;
      drawn.instanceCount = 1;
    }
  }

  DrawList& list_;
  const Snapshot& snapshot_;
  ClusterCulling culling_;
};

}  // namespace

void dropClusters(DrawList& list, const Snapshot& snapshot, const DrawOptions& options) {
  ClusterDraws draws(list, snapshot, options);
  draws.dropFrom(list.opaque);
  draws.dropFrom(list.layers.meshes);
  draws.dropFrom(list.transparent);
}

}  // namespace luxo
