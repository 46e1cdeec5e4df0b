// SPDX-License-Identifier: Apache-2.0
// A surface: a formula S(u,v), or the triangles of a mesh, behind one value. What both have is asked of both:
// name, identity, whether it is closed or flat, bounds, framing, the range of its (u, v). Where they differ
// two questions tell how a point is named and what is drawn: isParametric() and isPolygonal(). Only what
// reads the triangles or patches themselves knows of kinds: evaluation, meshes, searches, rays, shadows,
// exports.
//
// Of a formula everything is derived. In comes an expression graph, out goes position, exact derivatives,
// normals with limits at poles, seams, orientation, closedness and proven bounds.
//
// A surface is written once, as a generic function and its domain:
//
//     Surface torus = surface([=](auto u, auto v) { auto ring = 2 + 0.5 * cos(v);
//                                                   return point(ring * cos(u), 0.5 * sin(v), -ring *
//                                                   sin(u)); },
//                             {{0, kTau}, {0, kTau}});
//
// Seams, poles, their limit normals, closedness and orientation are found from the formula itself
// (surface/topology.h). What one formula on one rectangle cannot say is made of patches: a Klein bottle of
// two halves, a teapot of 32. Triangles have no patches: they are asked of their mesh (triangles()), and are
// the truth as they are. Values are cheap to copy: the description behind them is shared and immutable.
// Reading is safe from any thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "math/animated.h"
#include "math/bounds.h"
#include "math/interval.h"
#include "math/vec.h"
#include "surface/patch.h"
#include "surface/surface_function.h"
#include "surface/topology.h"

namespace luxo {

struct Cloth;
class TriangleMesh;
struct MeshGroup;
struct SurfaceDescription;
struct SurfaceTriangles;

/// Upper bounds of the lengths of second derivatives over a rectangle. Infinite when none could be proven.
struct PartialBounds {
  double uu = 0, uv = 0, vv = 0;
};

/// A truncated paraboloid of revolution: vertex at the origin, opening along +Y, focus at (0, focalLength,
/// 0).
struct Paraboloid {
  double focalLength = 0, height = 0;
};

/// Facts an author may state where the formula alone cannot tell.
struct SurfaceTraits {
  std::string name = "formula";
  double orientation =
      1;  ///< of the first patch of an open surface; closed ones are measured by their volume
  std::optional<Paraboloid> paraboloid;
  std::optional<Vec3> flatNormal;       ///< unit normal of a surface that lies in one plane
  bool revolution = false;              ///< u turns a profile once around the Y axis (see revolve())
  std::vector<PatchEdge> borders = {};  ///< edges that are not known to be joined or one point
};

/// Points and derivatives at several parameters: structure of arrays, one entry per point.
struct SurfacePoints {
  std::vector<Vec3> position, du, dv;
};

class Surface {
 public:
  Surface() = default;  ///< no surface: a node without geometry

  /// `parameters` are the values of the free variables beyond u, v and the patches' constants, in order; they
  /// may change with the moment. The topology is found for their values at time 0 without scene parameters:
  /// what depends on those is set afterwards, with withParameters(). Throws Error(Scene) for no patches, an
  /// empty or infinite domain, and a formula that is finite nowhere or one point everywhere. Holes in a
  /// formula are no error: see holes().
  explicit Surface(std::vector<Patch> patches, std::vector<Animated<double>> parameters = {},
                   SurfaceTraits traits = {});
  /// A surface of one patch.
  Surface(std::shared_ptr<const SurfaceFunction> function, Domain domain,
          std::vector<Animated<double>> parameters = {}, SurfaceTraits traits = {});

  /// The triangles of a mesh, which has to be valid.
  Surface(const TriangleMesh& mesh);  // NOLINT: it is a surface
  /// Some of them: those of a material. Closed where the mesh is: whoever sees it from outside sees fronts.
  Surface(const TriangleMesh& mesh, const MeshGroup& group);
  /// A cloth, as it lies at rest; snapshots of a scene have what it is like then. Its parameters are its
  /// numbers, in their order (surface/cloth.h), none of them a function of time. Error(Scene): what
  /// validate() says.
  explicit Surface(const Cloth& cloth);

  /// The same surface (identity, topology) with other values of its free parameters, as many as it has.
  [[nodiscard]] Surface withParameters(std::vector<Animated<double>> parameters) const;

  [[nodiscard]] bool valid() const { return description_ != nullptr; }
  /// Same identity = same patches, topology and traits. Formulas that are made alike, bit by bit, have one,
  /// so that what is known of a surface by its identity (meshes, shells, casters) is known of the same one in
  /// the next scene. Never null for a valid surface; unique while it lives.
  [[nodiscard]] const void* identity() const { return description_.get(); }

  [[nodiscard]] const std::string& name() const;
  /// Whether its points are S(u, v): it has patches, and at (u, v) a position, derivatives and a normal. Else
  /// (u, v) are texture coordinates that came with it, and a point is told by its place.
  [[nodiscard]] bool isParametric() const { return valid() && !patches().empty(); }
  /// Whether flat triangles are all there is to it: they are drawn as they are, whatever the tolerance and
  /// the shading, with their vertices' tangents, and vertex programs move them. Else a mesh is only near to
  /// it, and exact shading searches for its points, inside a shell: so far of what is parametric alone.
  [[nodiscard]] bool isPolygonal() const { return triangles() != nullptr; }
  /// Whether a mesh of it shows its own points: of triangles, and of what lies in one plane.
  [[nodiscard]] bool liesOnItsMesh() const { return isPolygonal() || flatNormal(); }
  /// Those of what is polygonal (surface/surface_triangles.h); else null.
  [[nodiscard]] const SurfaceTriangles* triangles() const;
  [[nodiscard]] const std::vector<Patch>& patches() const;
  [[nodiscard]] std::uint32_t patchCount() const { return static_cast<std::uint32_t>(patches().size()); }
  [[nodiscard]] const Domain& patchDomain(std::uint32_t patch) const;
  /// The smallest rectangle that holds all patches, or the (u, v) of all triangles; 0..1 where they have
  /// none.
  [[nodiscard]] const Domain& domain() const;
  [[nodiscard]] const Topology& topology() const;
  /// Of patches: the parameters' values for which the topology was found.
  [[nodiscard]] const std::vector<double>& initialParameters() const;
  [[nodiscard]] bool closed() const { return topology().closed; }
  [[nodiscard]] const std::vector<Animated<double>>& parameters() const { return *parameters_; }
  [[nodiscard]] std::optional<Paraboloid> paraboloid() const;
  /// Unit, of what lies in one plane.
  [[nodiscard]] std::optional<Vec3> flatNormal() const;
  [[nodiscard]] bool revolution() const;
  /// SurfaceTraits::borders.
  [[nodiscard]] const std::vector<PatchEdge>& statedBorders() const;

  /// S, Su, Sv at every (u[i], v[i]) of a patch. Object space, metres. Exact derivatives, rounded. Where the
  /// formula has no value the numbers are not finite.
  [[nodiscard]] SurfacePoints evaluate(std::uint32_t patch, std::span<const double> u,
                                       std::span<const double> v, std::span<const double> parameters) const;
  /// S, Su, Sv on the grid of all (u[i], v[j]), row by row (u fastest). What depends on u alone is evaluated
  /// once per column, what depends on v alone once per row.
  [[nodiscard]] SurfacePoints evaluateGrid(std::uint32_t patch, std::span<const double> u,
                                           std::span<const double> v,
                                           std::span<const double> parameters) const;
  [[nodiscard]] Vec3 position(std::uint32_t patch, double u, double v,
                              std::span<const double> parameters = {}) const;
  /// Unit normal, outward (the patch's orientation applied), with limits from inside the patch where Su x Sv
  /// vanishes. At an apex: the limit along the edge's normal direction. Never NaN or zero where the surface
  /// has a tangent plane; +Y where it has none.
  [[nodiscard]] Vec3 normal(std::uint32_t patch, double u, double v,
                            std::span<const double> parameters = {}) const;

  /// The patch that holds (u, v): the first, where patches meet. Outside all of them: the last.
  [[nodiscard]] std::uint32_t patchAt(double u, double v) const;
  /// As above, on the patch that holds the point.
  [[nodiscard]] Vec3 position(double u, double v, std::span<const double> parameters = {}) const;
  [[nodiscard]] Vec3 normal(double u, double v, std::span<const double> parameters = {}) const;
  /// A point of it: in the middle of its domain, or a vertex.
  [[nodiscard]] Vec3 somePoint(std::span<const double> parameters) const;
  /// As above, on the first patch: all there is of most surfaces.
  [[nodiscard]] SurfacePoints evaluate(std::span<const double> u, std::span<const double> v,
                                       std::span<const double> parameters) const;
  [[nodiscard]] SurfacePoints evaluateGrid(std::span<const double> u, std::span<const double> v,
                                           std::span<const double> parameters) const;

  /// What one rigorous interval evaluation proves about a cell.
  struct CellBounds {
    PartialBounds second;  ///< infinite where nothing could be proven
    /// The surface may have a kink or a jump inside: `second` holds for its smooth pieces only, and what a
    /// triangle misses is bounded by the diameter of `position` instead.
    bool kinked = false;
    Box position;  ///< holds the surface over the cell; only filled when kinked
  };
  /// `cell` lies within the patch. Cost: one interval evaluation; no allocation for patches without
  /// constants.
  [[nodiscard]] CellBounds boundCell(std::uint32_t patch, const Domain& cell,
                                     std::span<const double> parameters) const;
  /// The side of Su x Sv, +1, or the other, -1, that the surface bends away from all over the cell, whichever
  /// way one goes along it: a line that leaves it there does not meet it again in the cell, as far as that is
  /// a graph over some plane. 0: not proven. Cost: an interval evaluation.
  [[nodiscard]] int bendsAwayFrom(std::uint32_t patch, const Domain& cell,
                                  std::span<const double> parameters) const;
  /// Box that provably holds the surface over the cell; empty where it has no points there, infinite where
  /// nothing could be proven.
  [[nodiscard]] Box boundPosition(std::uint32_t patch, const Domain& cell,
                                  std::span<const double> parameters) const;

  /// Box that provably holds the whole surface; looser than the tightest by a few percent. Infinite where
  /// that cannot be proven: a formula that is unbounded.
  [[nodiscard]] Box bounds(std::span<const double> parameters) const;
  /// Finite box to look at: bounds() where that is finite, else one around most of the finite points of a
  /// sampling, those near a pole of the formula left out.
  [[nodiscard]] Box framing(std::span<const double> parameters) const;
  /// Proven suprema of |Suu|, |Suv|, |Svv| over all patches, within 10 % of the true ones where intervals
  /// allow; infinite for a surface with kinks. 0 of triangles, each of which is flat.
  [[nodiscard]] PartialBounds partialBounds(std::span<const double> parameters) const;

  /// Rectangles of the (u,v) plane where the formula has no finite value, a few at most, for a message: found
  /// by sampling, sides by bisection. Costs one interval evaluation per patch where there cannot be any.
  [[nodiscard]] std::vector<Domain> holes(std::span<const double> parameters) const;

 private:
  std::shared_ptr<const SurfaceDescription> description_;
  std::shared_ptr<const std::vector<Animated<double>>> parameters_;
};

/// The surface of a generic function `(auto u, auto v, auto... parameters) -> point(x, y, z)`: the arguments
/// after the traits give the formula's free variables their values, constant or functions of time.
template <class Formula, class... Parameters>
[[nodiscard]] Surface surface(const Formula& formula, Domain domain, SurfaceTraits traits = {},
                              Parameters... parameters) {
  Graph graph;
  const Expr u = graph.variable(0), v = graph.variable(1);
  std::uint32_t next = 2;
  // Braces fix the order of evaluation: the parameters become variables 2, 3, ...
  const std::array<Expr, sizeof...(Parameters)> free{
      (static_cast<void>(parameters), graph.variable(next++))...};
  const ExprPoint position = std::apply([&](auto... p) { return formula(u, v, p...); }, free);
  return Surface(cutAtKinks(graph, position, domain), {Animated<double>(parameters)...}, std::move(traits));
}

/// A profile in the half plane of the Y axis: its distance from the axis and its height.
struct ProfilePoint {
  Expr radius, height;
};

/// The surface that the profile `(auto v) -> ProfilePoint`, v in 0..1, leaves when u, in 0..1, turns it once
/// around the Y axis from +X toward -Z: (radius cos 2 pi u, height, -radius sin 2 pi u).
template <class Profile>
[[nodiscard]] Surface revolve(const Profile& profile, SurfaceTraits traits = {}) {
  traits.revolution = true;
  return surface(
      [&](auto u, auto v) {
        const ProfilePoint p = profile(v);
        return point(p.radius * cos(kTau * u), p.height, -(p.radius * sin(kTau * u)));
      },
      {}, std::move(traits));
}

}  // namespace luxo
