// SPDX-License-Identifier: Apache-2.0
// Surface + tolerance -> triangles with a proven error.
//
// The bound (Filip, Magedson, Markot 1986): on a cell of hu x hv parameters split into two right triangles
// the linear interpolant is at most (hu^2 Muu + 2 hu hv Muv + hv^2 Mvv) / 8 away from the surface at the same
// (u, v), with M the suprema of the second derivatives' lengths. Muu = 0 (a cylinder along its axis) asks for
// a single segment.
#pragma once

#include <limits>
#include <optional>
#include <span>

#include "surface/surface.h"
#include "tessellate/mesh.h"

namespace luxo {

/// What a mesh should be like. Object units.
struct MeshDesc {
  /// A plain grid of this many cells on every patch, instead of what follows.
  std::optional<Segments> uniform = std::nullopt;
  /// Largest distance between the surface and its triangles; positive.
  double tolerance = std::numeric_limits<double>::infinity();
  /// Largest extent of a triangle along u and along v, about: a size, not a proof. For what is interpolated
  /// between vertices and is not a shape.
  double longestEdge = std::numeric_limits<double>::infinity();
};

/// The triangles of a surface at given values of its parameters. Pure: equal input gives equal bits, on any
/// number of threads.
[[nodiscard]] Mesh tessellate(const Surface& surface, std::span<const double> parameters,
                              const MeshDesc& desc);

/// No direction is ever cut into more pieces; a tolerance that would need more is met as far as this allows,
/// and the mesh's bound says so.
inline constexpr std::uint32_t kMostSegments = 2048;

/// What a surface without provable bounds gets.
inline constexpr Segments kUnprovenSegments{256, 256};

/// The segments with the fewest triangles that stay within `tolerance` (object units, positive) by the bound.
/// A smaller tolerance never gives fewer triangles. Cost: a few operations per segment in u, after the
/// surface's own bounds.
[[nodiscard]] Segments segmentsFor(const Surface& surface, std::span<const double> parameters,
                                   double tolerance);

/// The bound above for given segments: object units. Infinite where none could be proven.
[[nodiscard]] double deviationBound(const Surface& surface, std::span<const double> parameters,
                                    Segments segments);

/// The fewest segments that make a surface of this topology without degenerate triangles: 3 along a closed
/// direction, 2 between two poles.
[[nodiscard]] Segments atLeastMinimal(const Surface& surface, Segments segments);

/// Uniform grid of `segments` cells (raised to the minimum above). Seams are closed by index, a pole is one
/// vertex, an apex one vertex per column with the normal of the column's middle; no triangle repeats a
/// vertex. Vertices: (u + 1)(v + 1), less one column or row per seam and all but one (pole) of a collapsed
/// row.
[[nodiscard]] Mesh tessellate(const Surface& surface, std::span<const double> parameters, Segments segments);

}  // namespace luxo
