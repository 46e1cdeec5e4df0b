// SPDX-License-Identifier: Apache-2.0
#include "scene/surface_names.h"

#include <fmt/format.h>

#include <array>
#include <iterator>
#include <map>

#include "base/assert.h"
#include "base/error.h"
#include "formula/tape.h"

namespace luxo {
namespace {

Expr dot(const ExprPoint& a, const ExprPoint& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

ExprPoint cross(const ExprPoint& a, const ExprPoint& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

ExprPoint scaled(const ExprPoint& a, Expr by) { return {a[0] * by, a[1] * by, a[2] * by}; }

ExprPoint derivative(Graph& graph, const ExprPoint& f, std::uint32_t variable) {
  return {graph.derivative(f[0], variable), graph.derivative(f[1], variable),
          graph.derivative(f[2], variable)};
}

/// Of one patch, in a graph of its own: the values of kSurfaceNames. The curvatures are written as in
/// surface/curvature.cpp, in the basis e1 = Su / |Su|, e2 across: the difference k1 - k2 of two numbers that
/// are nearly equal is no difference of their squares.
Tape valuesOf(const Surface& surface, std::uint32_t patch) {
  Graph graph;
  const std::vector<Expr> p = surface.patches()[patch].function->position.expressions(graph);
  const ExprPoint s{p[0], p[1], p[2]};
  const ExprPoint su = derivative(graph, s, kVariableU), sv = derivative(graph, s, kVariableV);
  const ExprPoint across = cross(su, sv);
  const Expr area = sqrt(dot(across, across));
  const ExprPoint normal = scaled(across, surface.topology().orientation(patch) / area);

  const Expr a = sqrt(dot(su, su)), b = dot(sv, su) / a, c = area / a;
  const Expr l = -dot(derivative(graph, su, kVariableU), normal),
             m = -dot(derivative(graph, su, kVariableV), normal),
             n = -dot(derivative(graph, sv, kVariableV), normal);
  const Expr b11 = l / (a * a), b12 = (m / a - b * b11) / c;
  const Expr b22 = (n - 2 * b * m / a + b * b * b11) / (c * c);
  const Expr mean = 0.5 * (b11 + b22), half = 0.5 * (b11 - b22), spread = sqrt(half * half + b12 * b12);
  const Expr values[] = {
      s[0], s[1],          s[2],         normal[0], normal[1], normal[2], b11 * b22 - b12 * b12,
      mean, mean + spread, mean - spread};
  static_assert(std::size(values) == kSurfaceNames.size());
  return {graph, values};
}

/// The variable, kept off the edges that are one point: there Su x Sv is 0, and the rest a quotient of zeros.
Expr offPoles(Expr variable, const Interval& range, const EdgeKind& lower, const EdgeKind& upper) {
  // A thousand times what floats lose of u and v; the normal of a ball is 0.02 degrees off.
  constexpr double kPart = 1e-4;
  if (lower.collapsed()) variable = max(variable, range.lo + kPart * range.width());
  if (upper.collapsed()) variable = min(variable, range.hi - kPart * range.width());
  return variable;
}

}  // namespace

std::vector<Expr> surfaceValues(Graph& graph, const Surface& surface, std::uint32_t firstParameter) {
  LUXO_REQUIRE_COMPARE(surface.patchCount(), <=, kMostNamedPatches);
  const Expr u = graph.variable(kVariableU), v = graph.variable(kVariableV);
  std::vector<Expr> values;
  // The first patch that holds the point, the last where none does: Surface::patchAt().
  for (std::uint32_t k = surface.patchCount(); k-- > 0;) {
    const Patch& patch = surface.patches()[k];
    const Topology& topology = surface.topology();
    std::map<std::uint32_t, Expr> variables{
        {kVariableU, offPoles(u, patch.domain.u, topology.edge(k, Side::UMin), topology.edge(k, Side::UMax))},
        {kVariableV,
         offPoles(v, patch.domain.v, topology.edge(k, Side::VMin), topology.edge(k, Side::VMax))}};
    std::uint32_t next = kFirstParameter;
    for (const double constant : patch.constants) variables[next++] = constant;
    for (std::uint32_t i = 0; i < surface.parameters().size(); ++i)
      variables[next++] = graph.variable(firstParameter + i);
    const std::vector<Expr> here = valuesOf(surface, k).expressions(graph, variables);
    if (values.empty()) {
      values = here;
      continue;
    }
    const Expr inside = min(lessEqual(u, patch.domain.u.hi), lessEqual(v, patch.domain.v.hi)) *
                        min(lessEqual(patch.domain.u.lo, u), lessEqual(patch.domain.v.lo, v));
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = select(inside, here[i], values[i]);
  }
  return values;
}

Pattern curvaturePattern(const Surface& surface) {
  if (surface.triangles()) return {};
  if (surface.patchCount() > kMostNamedPatches)
    throw Error(
        ErrorKind::Scene,
        fmt::format("its shader reads the curvature of its surface, which has {} formulas: at most {} are "
                    "supported",
                    surface.patchCount(), kMostNamedPatches),
        "give that surface a material whose shader does not");
  Graph graph;
  const std::vector<Expr> values = surfaceValues(graph, surface, kFirstParameter);
  constexpr std::size_t kBend = 6;
  static_assert(kSurfaceNames[kBend] == "K" && kSurfaceNames.size() == kBend + 4);
  return {graph, std::array{values[kBend], values[kBend + 1], values[kBend + 2], values[kBend + 3]},
          surface.parameters().size()};
}

}  // namespace luxo
