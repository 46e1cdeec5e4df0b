// SPDX-License-Identifier: Apache-2.0
// A parametric surface S(u,v): everything derived from one formula. In comes an expression graph, out goes
// position, exact derivatives, normals with limits at poles, seams, orientation, closedness and proven
// bounds.
//
// A surface is written once, as a generic function and its domain:
//
//     Surface torus = surface([=](auto u, auto v) { auto ring = 2 + 0.5 * cos(v);
//                                                   return point(ring * cos(u), 0.5 * sin(v), -ring *
//                                                   sin(u)); },
//                             {{0, kTau}, {0, kTau}});
//
// Seams, poles, their limit normals, closedness and orientation are found from the formula itself
// (surface/topology.h). Values are cheap to copy: the description behind them is shared and immutable.
// Reading is safe from any thread.
#pragma once

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
#include "surface/surface_function.h"

namespace luxo {

/// The rectangle of parameters a surface is defined on.
struct Domain {
  Interval u{0, 1}, v{0, 1};
};

/// What an edge of the parameter rectangle is on the surface.
enum class Edge {
  Border,  ///< an open border
  Seam,    ///< the same curve as the opposite edge, point for point: indices wrap
  Pole,    ///< one point, with one normal
  Apex,    ///< one point without a normal of its own: it depends on the direction of approach
};

/// The four edges of the parameter rectangle and what follows from them. A u edge can be a seam or a border;
/// write a surface so that what collapses to a point is a v edge.
struct Topology {
  Edge uMin = Edge::Border, uMax = Edge::Border, vMin = Edge::Border, vMax = Edge::Border;
  Vec3 vMinNormal{0}, vMaxNormal{0};  ///< at a pole: the unit limit of Su x Sv
  bool closed = false;                ///< encloses a volume
  /// +1 when Su x Sv points outward (closed surfaces) or to the conventional outside (open ones), else -1.
  double orientation = 1;

  [[nodiscard]] bool seamU() const { return uMin == Edge::Seam; }
  [[nodiscard]] bool seamV() const { return vMin == Edge::Seam; }
  [[nodiscard]] bool collapsedVMin() const { return vMin == Edge::Pole || vMin == Edge::Apex; }
  [[nodiscard]] bool collapsedVMax() const { return vMax == Edge::Pole || vMax == Edge::Apex; }
};

/// Upper bounds, over the whole domain, of the lengths of second derivatives. Infinite when none could be
/// proven.
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
  double orientation = 1;  ///< for open surfaces; closed ones are measured by their signed volume
  std::optional<Paraboloid> paraboloid;
  std::optional<Vec3> flatNormal;  ///< unit normal of a surface that lies in one plane
  bool revolution = false;         ///< u turns a profile once around the Y axis (see revolve())
};

/// Points and derivatives at several parameters: structure of arrays, one entry per point.
struct SurfacePoints {
  std::vector<Vec3> position, du, dv;
};

class Surface {
 public:
  Surface() = default;  ///< no surface: a node without geometry

  /// `parameters` are the values of the free variables beyond u and v, in order; they may change with time.
  /// Cost: one topology search (about 2,500 evaluations). Throws Error(Scene) for an empty or infinite domain
  /// and for a formula that is not finite anywhere on it.
  Surface(std::shared_ptr<const SurfaceFunction> function, Domain domain,
          std::vector<Animated<double>> parameters = {}, SurfaceTraits traits = {});

  [[nodiscard]] bool valid() const { return description_ != nullptr; }
  /// Same identity = same formula, domain and traits. Never null for a valid surface; unique while it lives.
  [[nodiscard]] const void* identity() const { return description_.get(); }

  [[nodiscard]] const std::string& name() const;
  [[nodiscard]] const Domain& domain() const;
  [[nodiscard]] const Topology& topology() const;
  [[nodiscard]] bool closed() const { return topology().closed; }
  [[nodiscard]] const std::vector<Animated<double>>& parameters() const;
  [[nodiscard]] std::optional<Paraboloid> paraboloid() const;
  [[nodiscard]] std::optional<Vec3> flatNormal() const;
  [[nodiscard]] bool revolution() const;

  /// S, Su, Sv at one point or at every (u[i], v[i]). Object space, metres. Exact derivatives, rounded.
  [[nodiscard]] SurfacePoints evaluate(std::span<const double> u, std::span<const double> v,
                                       std::span<const double> parameters) const;
  /// S, Su, Sv on the grid of all (u[i], v[j]), row by row (u fastest). What depends on u alone is evaluated
  /// once per column, what depends on v alone once per row.
  [[nodiscard]] SurfacePoints evaluateGrid(std::span<const double> u, std::span<const double> v,
                                           std::span<const double> parameters) const;
  [[nodiscard]] Vec3 position(double u, double v, std::span<const double> parameters = {}) const;
  /// Unit normal, outward (topology().orientation applied), with limits at poles. At an apex: the limit along
  /// u. Never NaN or zero where the surface has a tangent plane.
  [[nodiscard]] Vec3 normal(double u, double v, std::span<const double> parameters = {}) const;

  /// Box that provably holds the whole surface; looser than the tightest by a few percent.
  [[nodiscard]] Box bounds(std::span<const double> parameters) const;
  /// Proven suprema of |Suu|, |Suv|, |Svv|, within 10 % of the true ones where intervals allow.
  [[nodiscard]] PartialBounds partialBounds(std::span<const double> parameters) const;

 private:
  struct Description;
  std::shared_ptr<const Description> description_;
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
  return {compileSurface(graph, position), domain, {Animated<double>(parameters)...}, std::move(traits)};
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
