// SPDX-License-Identifier: Apache-2.0
#include "draw/cluster_draws.h"

#include <utility>
#include <vector>

#include "surface/surface_triangles.h"

namespace luxo {
namespace {

/// Triangles of a mesh that cost less than to look at its clusters, and than draws of its instances.
constexpr std::uint32_t kFewTriangles = 8 * kClusterTriangles;

/// Of all draws, for five million triangles: 64 MiB, and up to four copies of that. Meshes that have no room
/// left are drawn whole.
constexpr std::size_t kMaxClusterIndices = std::size_t{1} << 24;

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

  void occlude(const SnapshotNode& solid, MeshCache& meshes) {
    if (solid.surface.triangles()->count > kFewTriangles)
      culling_.occlude(solid, meshes.inscribedBalls(solid.surface));
  }

  /// What is hidden is so by what is opaque.
  void dropFrom(std::vector<DrawBatch>& batches, bool mayBeHidden) {
    std::vector<DrawBatch> kept;
    kept.reserve(batches.size());
    for (DrawBatch& batch : batches)
      if (hasClusters(batch))
        appendParts(kept, batch, mayBeHidden);
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

  /// Halves of a surface are not drawn where they are (Half).
  void appendParts(std::vector<DrawBatch>& kept, const DrawBatch& batch, bool mayBeHidden) {
    const std::uint32_t end = batch.firstInstance + batch.instanceCount;
    const bool wireframe = batch.state.shading == Shading::Wireframe;
    const ClusterNeeds needs{.faces = facesOf(batch.culling),
                             .lines = wireframe && !batch.state.hidesLines,
                             .mayBeHidden = mayBeHidden && batch.half == Half::Whole && !wireframe};
    const std::vector whole{TriangleRange{0, batch.triangleCount()}};
    std::vector<TriangleRange> last;  // of what the draw before this one is
    for (std::uint32_t i = batch.firstInstance; i < end; ++i) {
      ClusterCounts culled;
      std::vector<TriangleRange> parts = culling_.drawn(nodeOf(i), needs, culled);
      if (!hasRoomFor(parts)) {
        parts = whole;
        culled = {};
      }
      list_.clusters.culledFrustum += culled.culledFrustum;
      list_.clusters.culledBackface += culled.culledBackface;
      list_.clusters.culledHidden += culled.culledHidden;
      if (parts.empty()) continue;
      const bool joins = parts == last && kept.back().firstInstance + kept.back().instanceCount == i;
      if (joins) {
        ++kept.back().instanceCount;
        continue;
      }
      DrawBatch& drawn = kept.emplace_back(batch);
      drawn.firstInstance = i;
      drawn.instanceCount = 1;
      if (parts != whole) gather(parts, drawn);
      last = std::move(parts);
    }
  }

  [[nodiscard]] bool hasRoomFor(const std::vector<TriangleRange>& parts) const {
    std::size_t indices = list_.clusterIndices.size();
    for (const TriangleRange& part : parts) indices += std::size_t{3} * part.count;
    return indices <= kMaxClusterIndices;
  }

  void gather(const std::vector<TriangleRange>& parts, DrawBatch& batch) {
    std::vector<std::uint32_t>& indices = list_.clusterIndices;
    batch.someClusters = true;
    batch.firstIndex = static_cast<std::uint32_t>(indices.size());
    for (const TriangleRange& part : parts) {
      const auto first = batch.mesh->indices.begin() + std::ptrdiff_t{3} * part.first;
      indices.insert(indices.end(), first, first + std::ptrdiff_t{3} * part.count);
    }
    batch.indexCount = static_cast<std::uint32_t>(indices.size()) - batch.firstIndex;
  }

  DrawList& list_;
  const Snapshot& snapshot_;
  ClusterCulling culling_;
};

}  // namespace

void dropClusters(DrawList& list, const Snapshot& snapshot, std::span<const std::uint32_t> solids,
                  const DrawOptions& options, MeshCache& meshes) {
  ClusterDraws draws(list, snapshot, options);
  if (options.skips.hidden)
    for (const std::uint32_t solid : solids) draws.occlude(snapshot.nodes[solid], meshes);
  draws.dropFrom(list.opaque, true);
  draws.dropFrom(list.layers.meshes, false);
  draws.dropFrom(list.transparent, false);
}

}  // namespace luxo
