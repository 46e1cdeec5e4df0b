// SPDX-License-Identifier: Apache-2.0
#include "scene/surface_names.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <map>
#include <span>

#include "formula/tape.h"
#include "math/interval.h"
#include "math/numbers.h"

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

/// Of a function of patches, in a graph of its own: place, unit normal along Su x Sv, and with that K, H and
/// (k1 - k2) / 2. The curvatures are written as in surface/curvature.cpp, in the basis e1 = Su / |Su|, e2
/// across: the difference k1 - k2 of two numbers that are nearly equal is no difference of their squares.
Tape valuesOf(const SurfaceFunction& function) {
  Graph graph;
  const std::vector<Expr> p = function.position.expressions(graph);
  const ExprPoint s{p[0], p[1], p[2]};
  const ExprPoint su = derivative(graph, s, kVariableU), sv = derivative(graph, s, kVariableV);
  const ExprPoint across = cross(su, sv);
  const Expr area = sqrt(dot(across, across));
  const ExprPoint normal = scaled(across, 1 / area);

  const Expr a = sqrt(dot(su, su)), b = dot(sv, su) / a, c = area / a;
  const Expr l = -dot(derivative(graph, su, kVariableU), normal),
             m = -dot(derivative(graph, su, kVariableV), normal),
             n = -dot(derivative(graph, sv, kVariableV), normal);
  const Expr b11 = l / (a * a), b12 = (m / a - b * b11) / c;
  const Expr b22 = (n - 2 * b * m / a + b * b * b11) / (c * c);
  const Expr mean = 0.5 * (b11 + b22), half = 0.5 * (b11 - b22), spread = sqrt(half * half + b12 * b12);
  return {graph,
          std::array{s[0], s[1], s[2], normal[0], normal[1], normal[2], b11 * b22 - b12 * b12, mean, spread}};
}

/// Whose patch holds a point: the first that does, the last where none does (Surface::patchAt()).
class PatchChoice {
 public:
  PatchChoice(const Surface& surface, Expr u, Expr v) {
    for (const Patch& patch : surface.patches())
      inside_.push_back(min(lessEqual(u, patch.domain.u.hi), lessEqual(v, patch.domain.v.hi)) *
                        min(lessEqual(patch.domain.u.lo, u), lessEqual(patch.domain.v.lo, v)));
  }

  /// `numberOf`: a patch's number.
  template <typename NumberOf>
  [[nodiscard]] Expr operator()(const NumberOf& numberOf) const {
    std::uint32_t k = static_cast<std::uint32_t>(inside_.size()) - 1;
    const double last = numberOf(k);
    Expr chosen = last;
    bool varies = false;
    while (k-- > 0) {
      const double number = numberOf(k);
      varies = varies || number != last;
      if (varies) chosen = select(inside_[k], number, chosen);
    }
    return chosen;
  }

 private:
  std::vector<Expr> inside_;
};

/// Ends of a range that keep off edges which are one point: there Su x Sv is 0, and the rest a quotient of
/// zeros.
Interval offPoles(const Interval& range, const EdgeKind& lower, const EdgeKind& upper) {
  // A thousand times what floats lose of u and v; the normal of a ball is 0.02 degrees off.
  constexpr double kPart = 1e-4;
  return {lower.collapsed() ? range.lo + kPart * range.width() : -kInfinity,
          upper.collapsed() ? range.hi - kPart * range.width() : kInfinity};
}

Expr kept(Expr variable, Expr lowest, Expr highest) {
  if (!(lowest.isConstant() && lowest.constant() == -kInfinity)) variable = max(variable, lowest);
  if (!(highest.isConstant() && highest.constant() == kInfinity)) variable = min(variable, highest);
  return variable;
}

}  // namespace

std::vector<Expr> surfaceValues(Graph& graph, const Surface& surface, std::uint32_t firstParameter) {
  const std::span<const Patch> patches = surface.patches();
  const Topology& topology = surface.topology();
  const Expr u = graph.variable(kVariableU), v = graph.variable(kVariableV);
  const PatchChoice ofPatch(surface, u, v);
  const auto rangeU = [&](std::uint32_t k) {
    return offPoles(patches[k].domain.u, topology.edge(k, Side::UMin), topology.edge(k, Side::UMax));
  };
  const auto rangeV = [&](std::uint32_t k) {
    return offPoles(patches[k].domain.v, topology.edge(k, Side::VMin), topology.edge(k, Side::VMax));
  };
  std::map<std::uint32_t, Expr> variables{
      {kVariableU, kept(u, ofPatch([&](std::uint32_t k) { return rangeU(k).lo; }),
                        ofPatch([&](std::uint32_t k) { return rangeU(k).hi; }))},
      {kVariableV, kept(v, ofPatch([&](std::uint32_t k) { return rangeV(k).lo; }),
                        ofPatch([&](std::uint32_t k) { return rangeV(k).hi; }))}};
  std::vector<const Patch*> firstOf;  // for each function the first patch that has it
  const auto functionOf = [&](std::uint32_t k) {
    return std::ranges::find(firstOf, patches[k].function, [](const Patch* p) { return p->function; }) -
           firstOf.begin();
  };
  for (std::uint32_t k = 0; k < patches.size(); ++k)
    if (functionOf(k) == std::ssize(firstOf)) firstOf.push_back(&patches[k]);
  const Expr which = ofPatch([&](std::uint32_t k) { return static_cast<double>(functionOf(k)); });

  // Patches that share a function differ in its constants: these are chosen, and it is there once.
  std::vector<Expr> values;
  for (std::size_t f = firstOf.size(); f-- > 0;) {
    const std::vector<double>& own = firstOf[f]->constants;
    std::uint32_t next = kFirstParameter;
    for (std::size_t i = 0; i < own.size(); ++i)
      variables[next++] = ofPatch([&](std::uint32_t k) {
        return patches[k].function == firstOf[f]->function ? patches[k].constants[i] : own[i];
      });
    for (std::uint32_t i = 0; i < surface.parameters().size(); ++i)
      variables[next++] = graph.variable(firstParameter + i);
    const std::vector<Expr> here = valuesOf(*firstOf[f]->function).expressions(graph, variables);
    if (values.empty()) {
      values = here;
      continue;
    }
    const Expr isHere = lessEqual(which, static_cast<double>(f));
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = select(isHere, here[i], values[i]);
  }
  const Expr outward = ofPatch([&](std::uint32_t k) { return topology.orientation(k); });
  const Expr mean = outward * values[7], spread = values[8];
  const Expr named[] = {values[0],           values[1], values[2], outward * values[3], outward * values[4],
                        outward * values[5], values[6], mean,      mean + spread,       mean - spread};
  static_assert(std::size(named) == kSurfaceNames.size());
  return {std::begin(named), std::end(named)};
}

Pattern curvaturePattern(const Surface& surface) {
  if (!surface.isParametric()) return {};
  Graph graph;
  const std::vector<Expr> values = surfaceValues(graph, surface, kFirstParameter);
  constexpr std::size_t kBend = 6;
  static_assert(kSurfaceNames[kBend] == "K" && kSurfaceNames.size() == kBend + 4);
  return {graph, std::array{values[kBend], values[kBend + 1], values[kBend + 2], values[kBend + 3]},
          surface.parameters().size()};
}

}  // namespace luxo
