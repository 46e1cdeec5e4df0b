// SPDX-License-Identifier: Apache-2.0
// Which clusters of a mesh a draw needs: those in the picture some of whose triangles may show a face that is
// drawn, and that no solid hides.
//
// All are proofs. A cluster is left out as a node is where it is outside the picture (cull/cull.h).
//
// It is hidden by balls inside of solids (cull/occluder_grid.h), of those of which the near plane clips
// nothing in the picture: what it clips gets other corners, and may not close up. (At the sides the new
// corners are on the edges, but for kMovedPx.) And both are no more than kDeep times as deep at the far end
// of a cluster as at the near one: a device finds the depths of a triangle by a float plane, which is off
// everywhere by what it rounds away at the near end.
//
// Where only one face of triangles is drawn it is left out if the rasteriser finds each of its triangles to
// show the other: the eye is on that side of their planes, and they are so high in the picture that corners
// that move, by single precision and to the raster's grid, do not turn them over. How high: let D be at least
// the distance from the eye to their planes, h their smallest height, and let the cluster be from z to Z deep
// and at most r from the eye. The area of a triangle's image is f^2 A D over the product of its corners'
// depths, and no length grows by more than f r / z^2: so the height of its image is at least f h D z^2 / (Z^3
// r), and of parallel rays, with the sine D, f h D. A triangle turns over only where a corner crosses the
// line through the others, for which it has to be no higher than two corners may move.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cull/cull.h"
#include "cull/occluder_grid.h"
#include "math/frustum.h"
#include "mesh/triangle_mesh.h"
#include "scene/snapshot.h"

namespace luxo {

/// Consecutive triangles of a surface.
struct TriangleRange {
  std::uint32_t first = 0, count = 0;

  friend auto operator<=>(const TriangleRange&, const TriangleRange&) = default;
};

/// Which faces of triangles a draw shows.
enum class Faces { Both, Front, Back };

/// What a draw asks of the clusters of a mesh.
struct ClusterNeeds {
  Faces faces = Faces::Both;
  bool lines = false;        ///< their edges are drawn
  bool mayBeHidden = false;  ///< by solids: it is drawn where it is, and compared by depth
};

/// Triangles that draws do not need.
struct ClusterCounts {
  std::uint64_t culledFrustum = 0, culledBackface = 0, culledHidden = 0;
};

class ClusterCulling {
 public:
  /// Of one picture; `options` say which of the skips are allowed.
  ClusterCulling(const View& view, const CullOptions& options);

  /// A mesh with these balls inside hides what is behind. Required: it bounds a solid, is opaque, and seen
  /// from outside. Cost: 10 ns a cluster.
  void occlude(const SnapshotNode& solid, std::span<const Sphere> balls);

  /// What to draw of the mesh that a node's surface is; its own triangles are numbered from 0. Ascending,
  /// with gaps between. Cost: about 0.1 us a cluster.
  [[nodiscard]] std::vector<TriangleRange> drawn(const SnapshotNode& node, const ClusterNeeds& needs,
                                                 ClusterCounts& counts) const;

 private:
  /// Whether the near plane clips nothing of a ball, and its far end is not much deeper than its near one.
  [[nodiscard]] bool isShallow(const Sphere& world) const;

  View view_;
  bool frustum_, backface_;
  Frustum filled_, outlined_;
  OccluderGrid grid_;
};

}  // namespace luxo
