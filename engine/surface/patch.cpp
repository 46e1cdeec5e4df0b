// SPDX-License-Identifier: Apache-2.0
#include "surface/patch.h"

#include <map>

#include "formula/pieces.h"
#include "formula/removable.h"

namespace luxo {
namespace {

/// `range` in the parts that the lines, ascending, cut it into.
std::vector<Interval> parts(const Interval& range, const std::vector<double>& lines) {
  std::vector<Interval> parts;
  double from = range.lo;
  for (const double line : lines) {
    parts.emplace_back(from, line);
    from = line;
  }
  parts.emplace_back(from, range.hi);
  return parts;
}

}  // namespace

std::vector<double> GeneralForm::inputs(std::span<const double> constants,
                                        std::span<const double> parameters) const {
  std::vector<double> all(constants.begin(), constants.end());
  for (const Argument& argument : arguments)
    all.push_back(argument.parameter ? parameters[*argument.parameter] : argument.value);
  return all;
}

std::vector<Expr> expressionsOf(const Patch& patch, std::span<const double> parameters, Graph& graph) {
  const PatchInputs inputs(patch, parameters);
  std::map<std::uint32_t, Expr> known;
  for (const double input : std::span<const double>(inputs))
    known.emplace(static_cast<std::uint32_t>(2 + known.size()), input);
  return patch.function->position.expressions(graph, known);
}

std::vector<Patch> cutAtKinks(Graph& graph, const ExprPoint& position, const Domain& domain) {
  const std::vector<Expr> whole = continued(graph, position);
  const std::vector<Interval> columns = parts(domain.u, kinkLines(graph, whole, 0, domain.u));
  const std::vector<Interval> rows = parts(domain.v, kinkLines(graph, whole, 1, domain.v));
  if (columns.size() * rows.size() == 1)
    return {{compileSurface(graph, {whole[0], whole[1], whole[2]}), domain}};
  std::vector<Patch> patches;
  for (const Interval& v : rows)
    for (const Interval& u : columns) {
      const std::vector<Expr> p = pieceOf(graph, whole, u, v);
      patches.push_back({compileSurface(graph, {p[0], p[1], p[2]}), {u, v}});
    }
  return patches;
}

}  // namespace luxo
