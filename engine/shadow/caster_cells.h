// SPDX-License-Identifier: Apache-2.0
// A surface as rays of light meet it: small cells of its parameters, each with its tangents and a proven
// bound of how far it bends away from these.
//
// Over a cell with its middle at S0, half as wide as a and b (S0 + x a + y b, |x|, |y| <= 1, is its tangent
// parallelogram) Taylor's theorem says
//
//     |S - (S0 + x a + y b)| <= bend = (|Suu| hu^2 + 2 |Suv| hu hv + |Svv| hv^2) / 2
//
// with proven suprema of the second derivatives (tessellate/curvature_map.h). From that
// shaders/lib/cell_ray.glsl concludes whether a ray meets the cell (D. Toth, "On ray tracing parametric
// surfaces", 1985; R. Krawczyk 1969).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "math/bounds.h"
#include "surface/spread.h"
#include "surface/surface.h"
#include "tessellate/curvature_map.h"

namespace luxo {

/// Object space, metres.
struct CasterCell {
  std::uint32_t patch = 0;
  Domain domain;
  /// Suprema of |Suu|, |Suv|, |Svv| per square of the parameters' units; infinite where nothing is proven.
  double uu = 0, uv = 0, vv = 0;
  Vec3 middle{0};     ///< the middle point
  Vec3 reach{0};      ///< no point of the cell is farther from the middle, by axis; infinite if unknown
  Vec3 a{0}, b{0};    ///< of a triangle: 0
  double bend = 0;    ///< infinite where nothing is proven: a and b are 0 then
  int bendsAway = 0;  ///< Surface::bendsAwayFrom(), of all its parts; 0 of a surface with parameters

  [[nodiscard]] bool proven() const;
};

struct CasterCells {
  std::vector<CasterCell> cells;
  Box bounds;                      ///< of all cells; infinite where one is
  double size = 0;                 ///< of the surface, about
  std::optional<Vec3> flatNormal;  ///< of a surface in one plane; object space
  bool convex = false;             ///< isEllipsoid()
  double rounding = 0;             ///< how far single precision moves its points (surface/formula_rounding.h)

  /// Whether light rays can be held against them: they end somewhere.
  [[nodiscard]] bool finite() const { return isFinite(bounds); }
};

/// Whether it is all of an ellipsoid: no point of it that faces a light is in its own shadow.
[[nodiscard]] bool isEllipsoid(const Surface& surface, std::span<const double> parameters);

/// Cells bend by at most that part of the surface's size, and are no longer than that part of it, unless that
/// takes too many. A cell that bends less is settled sooner, but there are more to look at (measured on the
/// torus and the teapot: 1/64 to 1/1024 differ by a tenth).
inline constexpr double kCellBend = 1.0 / 256, kCellLength = 1.0 / 8;
inline constexpr std::size_t kMaxCasterCells = 16'384;

/// Triangles of casters that shaders look for; of more rays tell.
inline constexpr std::size_t kMaxCasterTriangles = 1U << 18;

/// A cell for each triangle: nothing bends, and where it is the grid is to know. As many as
/// kMaxCasterTriangles.
[[nodiscard]] CasterCells makeCasterCells(const Surface& surface, const SurfaceTriangles& triangles);
/// Cost: a microsecond a cell, beside the map.
[[nodiscard]] CasterCells makeCasterCells(const Surface& surface, std::span<const double> parameters,
                                          const CurvatureMap& map);

}  // namespace luxo
