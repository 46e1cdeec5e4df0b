// SPDX-License-Identifier: Apache-2.0
// Which clusters of a mesh a draw needs: those in the picture some of whose triangles may show a face that is
// drawn.
//
// Both are proofs. A cluster is left out as a node is where it is outside the picture (cull/cull.h). Where
// only one face of triangles is drawn it is left out if the rasteriser finds each of its triangles to show
// the other: the eye is on that side of their planes, and they are so high in the picture that corners that
// move, by single precision and to the raster's grid, do not turn them over. How high: let D be at least the
// distance from the eye to their planes, h their smallest height, and let the cluster be from z to Z deep and
// at most r from the eye. The area of a triangle's image is f^2 A D over the product of its corners' depths,
// and no length grows by more than f r / z^2: so the height of its image is at least f h D z^2 / (Z^3 r), and
// of parallel rays, with the sine D, f h D. A triangle turns over only where a corner crosses the line
// through the others, for which it has to be no higher than two corners may move.
#pragma once

#include <cstdint>
#include <vector>

#include "cull/cull.h"
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

/// Triangles that draws do not need.
struct ClusterCounts {
  std::uint64_t culledFrustum = 0, culledBackface = 0;
};

class ClusterCulling {
 public:
  /// Of one picture; `options` say which of the skips are allowed.
  ClusterCulling(const View& view, const CullOptions& options);

  /// What to draw of the mesh that a node's surface is; its own triangles are numbered from 0. Short gaps are
  /// drawn, too, as they cost less than another draw. Cost: about 0.1 us a cluster.
  [[nodiscard]] std::vector<TriangleRange> drawn(const SnapshotNode& node, Faces faces, bool lines,
                                                 ClusterCounts& counts) const;

 private:
  View view_;
  bool frustum_, backface_;
  Frustum filled_, outlined_;
};

}  // namespace luxo
