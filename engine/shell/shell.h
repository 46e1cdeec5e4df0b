// SPDX-License-Identifier: Apache-2.0
// Triangles around a surface instead of on it: where a renderer begins to search for the surface itself.
//
// Every patch is wrapped in a slab of its own. The top is the mesh of the patch with its vertices moved
// outward, the bottom the same inward, walls join the two along the patch's edges, a little outside of them.
// A vertex moves the shortest way that brings the planes of all triangles around it, and of all walls,
// farther away than the surface is proven to be on that side (shell_heights.h): so every triangle's plane
// lies beyond the part of the surface that the triangle stands for, and whatever ray meets the patch enters
// its slab before. No walls stand along edges that collapse to a point, nor where the patch is joined to
// itself and its formula goes on: there the top and the bottom go on too.
//
// A ray that entered the slab starts its search for the surface at the (u, v) of the place it entered by, or,
// where the surface has an equation, at that place.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "math/vec.h"
#include "shell/shell_occluder.h"
#include "surface/equation.h"
#include "surface/surface.h"
#include "tessellate/curvature_map.h"

namespace luxo {

/// Cells that a search may lead away, and a cell that its vertex may be away.
inline constexpr double kSearchedCells = 3;

/// What is the same all over a patch.
struct ShellPatch {
  Domain domain;
  double originOfU = 0;  ///< Patch::originOfU
  /// The u (v) edges are one curve and the formula has a period, the domain's width (formula/degree.h): a
  /// parameter outside the domain stands for one inside.
  bool wrapsU = false, wrapsV = false;
  /// That edge is one point.
  bool collapsedUMin = false, collapsedUMax = false, collapsedVMin = false, collapsedVMax = false;
  [[nodiscard]] bool hasPole() const {
    return collapsedUMin || collapsedUMax || collapsedVMin || collapsedVMax;
  }

  bool bordered = false;   ///< an edge of it is a border of the surface
  double orientation = 1;  ///< +1: Su x Sv points outward, out of the top
  /// Where there is one. Patches that share a function have equations of one form, or none.
  std::optional<Equation> equation = {};
};

/// The directions in which the surface's outer side faces near a triangle of a shell.
struct NormalCone {
  Vec3f axis{0};   ///< unit, object space, outward
  float sine = 2;  ///< of the angle around it; above 1: any direction
  /// Of the angle to the surface from which on what most rays meet is certified to be the first without a
  /// walk; above 1: from no angle.
  float certain = 0;
};

/// Indexed triangle lists in object space, metres, double; counter-clockwise as seen from outside the slab.
struct Shell {
  std::vector<Vec3> positions;
  std::vector<Vec2> parameters;  ///< (u, v) of the point of the surface that the vertex stands for
  std::vector<Vec2> cells;       ///< extents in u and v of the largest triangle around the vertex
  /// Proven: how much derivatives by u and v, each per cell, change over such a cell anywhere within
  /// kSearchedCells of the vertex; object units.
  std::vector<double> changes;
  std::vector<std::uint32_t> patches;  ///< of each vertex, as in Surface::patches()

  /// The patches that share one function, as consecutive indices: top, then walls, then bottom, which has as
  /// many as the top. From outside the slab a ray meets the front of the surface through top and walls, its
  /// back through bottom and walls; and, where that is not shown, through it the front farther on.
  struct Part {
    std::uint32_t patch = 0;  ///< the first of them
    std::uint32_t firstIndex = 0, frontCount = 0, count = 0;
    /// Of the top, or the bottom.
    [[nodiscard]] std::uint32_t faceCount() const { return count - frontCount; }
    [[nodiscard]] std::uint32_t wallCount() const { return count - 2 * faceCount(); }
    [[nodiscard]] std::uint32_t wallIndex() const { return firstIndex + faceCount(); }
    [[nodiscard]] std::uint32_t bottomIndex() const { return wallIndex() + wallCount(); }
  };
  std::vector<std::uint32_t> indices;
  std::vector<Part> parts;
  /// Of each triangle, those of the bottom as those of the top. Any direction near edges that are points.
  std::vector<NormalCone> cones;
  ShellOccluder occluder;             ///< slabs that no ray passes through beside the surface
  std::vector<ShellPatch> patchData;  ///< of every patch of the surface

  double bound = 0;   ///< proven deviation of the mesh that the shell is made of; see Mesh::bound
  double offset = 0;  ///< how far vertices were moved, at most
  /// How far a point moves, at most, as far as the mesh tells, when its u and v change by all of themselves:
  /// numbers with n bits round away 2^-n of that. Of patches without equations; object units.
  double parameterReach = 0;
  /// How far single precision moves a point where the formula is computed in it (surface/formula_rounding.h).
  /// Of patches without equations; object units.
  double formulaRounding = 0;
  /// Half of the surface's area bends more sharply than with this radius in some direction, as far as the
  /// mesh tells; infinite of what is mostly flat. Object units.
  double medianRadius = 0;
  /// Where no direction leads out of the triangles around a vertex, and the shell may leave out some of the
  /// surface near it: these boxes hold what they leave out. Object space.
  std::vector<Box> pinches;
  /// The surface is enclosed. False where the mesh has no finite bound, triangles are missing, or turn so
  /// sharply that no direction leads out (pinch points): the shell is then as good as one can be made. Where
  /// a surface is thinner than the tolerance, slabs of its parts overlap.
  bool proven = true;
  Vec3 origin{0};  ///< what the device's single precision is relative to, as in Mesh

  [[nodiscard]] std::size_t triangleCount() const { return indices.size() / 3; }
};

/// A search by an equation may begin so many times as far off as one by a formula, as its steps are longer;
/// but no farther than twice such a part of the surface's size, or twice what a formula's search does.
inline constexpr double kEquationTolerance = 4, kCoarseEquation = 1.0 / 64;

/// Above 0, so that a slab around what is flat has a thickness.
inline constexpr double kLeastMargin = 1.0 / 64;

struct ShellDesc {
  /// Largest deviation of the mesh under the shell, object units; that times kEquationTolerance where all
  /// patches have equations. The slab is half as thick, mostly less. A few pixels are best: finer have more
  /// triangles, coarser ones start the search too far off.
  double tolerance = 0;
  /// How far the slab reaches beyond the surface on all sides, borders included: an ellipsoid around each
  /// point of the surface is inside. Its half axes, parts of the tolerance.
  Vec3 margin{kLeastMargin};
  /// Largest angle between the direction in which a vertex moves and the normals of the triangles around it,
  /// radians. What turns faster is tessellated more finely, as far as that helps and is not much thinner than
  /// the tolerance; so is what turns by more than a radian within a triangle.
  double mostTurn = 0.8;
  /// A shell of more is not made.
  double mostTriangles = std::numeric_limits<double>::infinity();
  /// Asked now and then, on this thread: once it says so the shell is not made.
  std::function<bool()> interrupted = {};
};

/// Pure: equal input gives equal bits. Nothing where it would have more triangles than desc.mostTriangles,
/// where the formula ends within a patch, and when interrupted. Cost: that of up to seven meshes, the more
/// the coarser they are.
[[nodiscard]] std::optional<Shell> makeShell(const Surface& surface, std::span<const double> parameters,
                                             const CurvatureMap& map, const ShellDesc& desc);

}  // namespace luxo
