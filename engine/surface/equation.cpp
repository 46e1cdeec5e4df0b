// SPDX-License-Identifier: Apache-2.0
#include "surface/equation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "formula/degree.h"
#include "math/sampling.h"
#include "mesh/mesh_solid.h"
#include "surface/surface.h"
#include "surface/surface_triangles.h"

namespace luxo {
namespace {

using Along = Equation::Along;

constexpr double kAgreement = 1e-12;    // of the size: 10^4 roundings
constexpr double kRounding = 1 + 1e-9;  // of a reach
constexpr int kSamples = 400;

/// 0..1 around the circle.
double turn(double angle) {
  const double part = angle / kTau;
  return part < 0 ? part + 1 : part;
}

double placeAlong(Along along, const Vec3& q) {
  const double radius = std::hypot(q.x, q.z);
  switch (along) {
    case Along::X:
      return q.x;
    case Along::Y:
      return q.y;
    case Along::Z:
      return q.z;
    case Along::Radius:
      return radius;
    case Along::Turn:
      return turn(std::atan2(-q.z, q.x));
    case Along::Latitude:
      return std::atan2(q.y, radius) / kPi;
    case Along::Tube:
      break;
  }
  return turn(std::atan2(q.y, radius - 1));
}

double parameter(const Equation::Parameter& p, const Vec3& q) {
  return p.start + p.rate * placeAlong(p.along, q);
}

bool isWhole(Along along) { return along == Along::Turn || along == Along::Latitude || along == Along::Tube; }

/// Tries one form after the other on a patch.
struct Recognition {
  const Surface& surface;
  std::uint32_t patch;
  std::span<const double> parameters;

  [[nodiscard]] Vec3 at(double u, double v) const { return surface.position(patch, u, v, parameters); }

  [[nodiscard]] Equation rectangle() const {
    return {.scale = {2 * at(1, 0.5).x, 1, -2 * at(0.5, 1).z},
            .y = 1,
            .u = {Along::X, 0.5, 1},
            .v = {Along::Z, 0.5, -1}};
  }
  [[nodiscard]] Equation saddle() const {
    return {.scale = {at(1, 0.5).x, at(1, 0.5).y, -at(0.5, 1).z},
            .xx = -1,
            .zz = 1,
            .y = 1,
            .u = {Along::X, 0.5, 0.5},
            .v = {Along::Z, 0.5, -0.5},
            .reach = 2};
  }
  [[nodiscard]] Equation disk() const {
    return {.scale = Vec3(at(0, 1).x), .y = 1, .v = {Along::Radius, 0, 1}};
  }
  [[nodiscard]] Equation cone() const {  // and the cylinder
    const double bottom = at(0, 0).x, top = at(0, 1).x, widest = std::max(bottom, top);
    const double r = bottom / widest, slope = (top - bottom) / widest;
    return {.scale = {widest, at(0, 1).y, widest},
            .xx = 1,
            .yy = -slope * slope,
            .zz = 1,
            .y = -2 * r * slope,
            .constant = -r * r,
            .v = {Along::Y, 0, 1},
            .reach = std::sqrt(2.0)};
  }
  [[nodiscard]] Equation ellipsoid() const {
    return {.scale = {at(0, 0.5).x, at(0, 1).y, -at(0.25, 0.5).z},
            .xx = 1,
            .yy = 1,
            .zz = 1,
            .constant = -1,
            .v = {Along::Latitude, 0.5, 1}};
  }
  [[nodiscard]] Equation paraboloid() const {
    const Vec3 rim = at(0, 1);
    return {.scale = {rim.x, rim.y, rim.x},
            .xx = 1,
            .zz = 1,
            .y = -1,
            .v = {Along::Radius, 0, 1},
            .reach = std::sqrt(2.0)};
  }
  [[nodiscard]] Equation oneSheet() const {
    const double waist = at(0, 0.5).x, rim = at(0, 1).x / waist;
    return {.scale = {waist, at(0, 1).y, waist},
            .xx = 1,
            .yy = 1 - rim * rim,
            .zz = 1,
            .constant = -1,
            .v = {Along::Y, 0.5, 0.5},
            .reach = std::hypot(rim, 1)};
  }
  [[nodiscard]] Equation sheetOfTwo(double side) const {
    const double vertex = at(0, 0.5).y * side, radius = at(0, 0.5 + 0.5 * side).x;
    const double rim = at(0, 0.5 + 0.5 * side).y * side / vertex, opening = rim * rim - 1;
    return {.scale = {radius, vertex, radius},
            .xx = -opening,
            .yy = 1,
            .zz = -opening,
            .constant = -1,
            .v = {Along::Radius, 0.5, 0.5 * side},
            .sheet = side,
            .reach = std::hypot(rim, 1)};
  }
  [[nodiscard]] Equation lowerSheet() const { return sheetOfTwo(-1); }
  [[nodiscard]] Equation upperSheet() const { return sheetOfTwo(1); }
  [[nodiscard]] Equation torus() const {
    const double outer = at(0, 0).x, inner = at(0, 0.5).x, ring = 0.5 * (outer + inner);
    return {.scale = Vec3(ring),
            .tube = 0.5 * (outer - inner) / ring,
            .v = {Along::Tube, 0, 1},
            .reach = outer / ring};
  }

  /// Sets where the outer side is.
  [[nodiscard]] bool agrees(Equation& equation) const {
    const Domain& domain = surface.patchDomain(patch);
    for (int i = 0; i < 3; ++i)
      if (!(equation.scale[i] > 0 && std::isfinite(equation.scale[i]))) return false;
    if (surface.boundCell(patch, domain, parameters).kinked) return false;
    const Interval whole(0, 1);
    if ((isWhole(equation.u.along) && domain.u != whole) || (isWhole(equation.v.along) && domain.v != whole))
      return false;
    const double size =
        equation.reach * std::max({equation.scale.x, equation.scale.y, equation.scale.z}) * kRounding;
    double side = 0;
    for (int k = 0; k < kSamples; ++k) {
      // Inside, spread evenly, and the edges of v, which are never inside by chance.
      Vec2 part = quasirandomPoint(k);
      if (k % 10 == 0) part.y = (k % 20) / 10.0;
      const double inU = domain.u.lo + part.x * domain.u.width(),
                   inV = domain.v.lo + part.y * domain.v.width();
      const Vec3 p = at(inU, inV), unitPoint = p / equation.scale, steep = equation.gradient(unitPoint);
      if (!(std::abs(equation.at(unitPoint)) <=
            kAgreement * equation.reach * (glm::length(steep) + kAgreement)))
        return false;
      if (!(glm::length(unitPoint) <= equation.reach * kRounding) || equation.sheet * unitPoint.y < 0)
        return false;
      const Vec2 back = equation.parametersOf(unitPoint);
      const double backU = std::clamp(back.x, domain.u.lo, domain.u.hi);
      const double backV = std::clamp(back.y, domain.v.lo, domain.v.hi);
      if (!(glm::length(at(backU, backV) - p) <= kAgreement * size)) return false;
      side += glm::dot(surface.normal(patch, inU, inV, parameters) * equation.scale, steep);
    }
    equation.outward = side < 0 ? -1 : 1;
    return true;
  }

  /// Whether the formula is between those places what it is there: F of it then has a degree of 4 at most.
  [[nodiscard]] bool hasLowDegree(const Equation& equation) const {
    const double most = equation.form() == Equation::Form::Quadric ? 2 : 1;
    const Patch& of = surface.patches()[patch];
    Graph graph;
    const std::vector<Expr> position = expressionsOf(of, parameters, graph);
    const Vec2 width(of.domain.u.width(), of.domain.v.width());
    return std::ranges::all_of(degreesOf(graph, position, width), [&](const Vec2& degree) {
      return std::max(degree.x, degree.y) <= most * kRounding;
    });
  }
};

}  // namespace

double Equation::at(const Vec3& p) const {
  if (form() == Form::Quadric) return xx * p.x * p.x + yy * p.y * p.y + zz * p.z * p.z + y * p.y + constant;
  const double sum = glm::dot(p, p) + (1 - tube) * (1 + tube);
  return sum * sum - 4 * (p.x * p.x + p.z * p.z);
}

Vec3 Equation::gradient(const Vec3& p) const {
  if (form() == Form::Quadric) return {2 * xx * p.x, 2 * yy * p.y + y, 2 * zz * p.z};
  return 4 * (glm::dot(p, p) + (1 - tube) * (1 + tube)) * p - 8.0 * Vec3(p.x, 0, p.z);
}

Vec2 Equation::parametersOf(const Vec3& unitPoint) const {
  return {parameter(u, unitPoint), parameter(v, unitPoint)};
}

Box Equation::edgesOf(const Domain& domain) const {
  Box edges{Vec3(-kInfinity), Vec3(kInfinity)};
  const auto limit = [&](const Parameter& parameter, const Interval& range) {
    const auto axis = parameter.along == Along::Radius ? 0 : static_cast<int>(parameter.along);
    if (axis > 2) return;  // whole
    const double a = (range.lo - parameter.start) / parameter.rate * scale[axis];
    const double b = (range.hi - parameter.start) / parameter.rate * scale[axis];
    edges.min[axis] = std::min(a, b);
    edges.max[axis] = std::max(a, b);
  };
  limit(u, domain.u);
  limit(v, domain.v);
  if (sheet > 0) edges.min.y = 0;
  if (sheet < 0) edges.max.y = 0;
  return edges;
}

double Equation::center() const {
  if (form() == Form::Torus || yy == 0) return 0;
  const double middle = -0.5 * y / yy;
  return std::abs(middle) <= 2 * reach ? middle : 0;
}

std::optional<Equation> equationOf(const Surface& surface, std::uint32_t patch,
                                   std::span<const double> parameters) {
  const Recognition recognition{surface, patch, parameters};
  for (const auto form :
       {&Recognition::rectangle, &Recognition::disk, &Recognition::cone, &Recognition::ellipsoid,
        &Recognition::torus, &Recognition::paraboloid, &Recognition::oneSheet, &Recognition::saddle,
        &Recognition::lowerSheet, &Recognition::upperSheet}) {
    Equation equation = (recognition.*form)();
    if (recognition.agrees(equation))
      return recognition.hasLowDegree(equation) ? std::optional(equation) : std::nullopt;
  }
  return std::nullopt;
}

std::vector<std::optional<Equation>> equationsOf(const Surface& surface, std::span<const double> parameters) {
  std::vector<std::optional<Equation>> equations;
  for (std::uint32_t patch = 0; patch < surface.patchCount(); ++patch)
    equations.push_back(equationOf(surface, patch, parameters));
  const auto formOf = [&](std::size_t patch) {
    return equations[patch] ? std::optional(equations[patch]->form()) : std::nullopt;
  };
  const std::vector<Patch>& patches = surface.patches();
  std::map<const SurfaceFunction*, std::set<std::optional<Equation::Form>>> forms;
  for (std::size_t i = 0; i < equations.size(); ++i) forms[patches[i].function.get()].insert(formOf(i));
  for (std::size_t i = 0; i < equations.size(); ++i)
    if (forms[patches[i].function.get()].size() > 1) equations[i].reset();
  return equations;
}

bool boundsSolid(const Surface& surface, std::span<const double> parameters) {
  if (const SurfaceTriangles* triangles = surface.triangles())
    return triangles->count == triangles->mesh.triangleCount() && boundsSolid(triangles->mesh);
  if (surface.patchCount() != 1) return false;
  const std::optional<Equation> equation = equationOf(surface, 0, parameters);
  return equation &&
         (equation->v.along == Equation::Along::Latitude || equation->v.along == Equation::Along::Tube);
}

}  // namespace luxo
