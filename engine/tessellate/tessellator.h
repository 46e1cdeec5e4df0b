// SPDX-License-Identifier: Apache-2.0
// Surface + tolerance -> triangles with a proven error.
//
// The bound (Filip, Magedson, Markot 1986): a triangle whose corners lie within hu x hv parameters of each
// other is, point by point at the same (u, v), at most (hu^2 Muu + 2 hu hv Muv + hv^2 Mvv) / 8 away from the
// surface, with M the suprema of the second derivatives' lengths: by Taylor the error at a point is at most
// sum l_i (du_i^2 Muu + 2 |du_i dv_i| Muv + dv_i^2 Mvv) / 2 over the corners with weights l_i and distances
// (du_i, dv_i), and the variance of anything that spans hu is at most hu^2 / 4. The shape of the triangle
// does not matter, so triangles that join different grids obey the bound of the coarser grid's cells.
//
// The mixed term measures how far points slide along the surface, which moves nothing that is seen
// - on a flat surface, which is covered exactly whatever its interior edges are: only its borders deviate;
// - on a surface of revolution, whose profile stays on one side of the axis: the corners of a triangle within
//   hu of angle have a mean radius R, and the mean of the corners lies between R cos(hu / 2) and R from the
//   axis, R being within hv^2 Mvv / 8 of the profile; compared with the point of the surface at the same
//   angle, that is hu^2 Muu / 8 + hv^2 Mvv / 8.
//
// Parts of the surface that bend differently are cut into blocks of different cells, see block_plan.h; that
// no crack opens between them is the work of edge_net.h.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "surface/segments.h"
#include "surface/surface.h"
#include "tessellate/mesh.h"

namespace luxo {

class CurvatureMap;

/// About the most triangles of a mesh. A tolerance that would need more, or more than kMaxSegments along a
/// patch, is met as far as this allows, and the mesh's bound says so.
inline constexpr double kMaxTriangles = 1 << 21;

/// What a mesh should be like. Object units.
struct MeshDesc {
  /// A plain grid of this many cells on every patch, instead of what follows. Raised to the least that makes
  /// no triangle of two corners: 3 along a closed direction, 2 between two poles.
  std::optional<Segments> uniform = std::nullopt;
  /// Largest distance between the surface and its triangles; positive.
  double tolerance = std::numeric_limits<double>::infinity();
  /// Largest extent of a triangle along u and along v, about, but at most 128 segments along a patch: a size,
  /// not a proof. For what is interpolated between vertices and is not a shape.
  double longestEdge = std::numeric_limits<double>::infinity();
};

/// The triangles of a surface at given values of its parameters: its own, whatever is asked for, where it has
/// some. Pure: equal input gives equal bits, on any
/// number of threads. Cost: that of the curvature map (unless uniform), of planning (below a millisecond for
/// most surfaces), and of about half as many evaluations of the surface as there are triangles.
[[nodiscard]] Mesh tessellate(const Surface& surface, std::span<const double> parameters,
                              const MeshDesc& desc);
/// As above, with a map that is there already.
[[nodiscard]] Mesh tessellate(const Surface& surface, std::span<const double> parameters,
                              const CurvatureMap& map, const MeshDesc& desc);

/// The bound above for a uniform grid: object units. Infinite where none could be proven.
[[nodiscard]] double deviationBound(const Surface& surface, std::span<const double> parameters,
                                    Segments segments);

}  // namespace luxo
