// SPDX-License-Identifier: Apache-2.0
#include "shadow/caster_cache.h"

#include <array>

#include "surface/formula_rounding.h"

namespace luxo {
namespace {

/// Whether they are the two sheets of one hyperboloid, which end alike across its axis: so all that is within
/// the hull of their edges and where F is zero is of one of them.
bool areItsSheets(const CasterEquation& a, const CasterEquation& b) {
  const Equation &e = a.equation, &f = b.equation;
  const auto field = [](const Equation& of) {
    return std::array{of.scale.x, of.scale.y, of.scale.z, of.xx, of.yy, of.zz, of.y, of.constant, of.tube};
  };
  const auto across = [](const Box& edges) {
    return std::array{edges.min.x, edges.max.x, edges.min.z, edges.max.z};
  };
  return e.sheet * f.sheet < 0 && field(e) == field(f) && e.isRadial() == f.isRadial() &&
         across(a.edges) == across(b.edges);
}

}  // namespace

std::optional<CasterEquation> casterEquation(const Surface& surface, std::span<const double> parameters) {
  const auto sheet = [&](std::uint32_t patch) -> std::optional<CasterEquation> {
    const std::optional<Equation> equation = equationOf(surface, patch, parameters);
    if (!equation) return std::nullopt;
    const Box edges = equation->edgesOf(surface.patchDomain(patch));
    return CasterEquation{*equation,
                          {edges.min / equation->scale, edges.max / equation->scale},
                          equation->v.along == Equation::Along::Latitude};
  };
  if (surface.patchCount() == 0 || surface.patchCount() > 2) return std::nullopt;
  std::optional<CasterEquation> caster = sheet(0);
  if (!caster || surface.patchCount() == 1) return caster;
  // Points of either sheet are where the one F is zero.
  const std::optional<CasterEquation> other = sheet(1);
  if (!other || !areItsSheets(*caster, *other)) return std::nullopt;
  caster->edges.add(other->edges);
  caster->equation.sheet = 0;
  return caster;
}

std::shared_ptr<const CasterCells> CasterCache::cells(const Surface& surface,
                                                      std::span<const double> parameters) {
  const Key key{.shape = Shape(surface, parameters)};
  if (auto known = cells_.find(key)) return known;
  if (surface.triangles()) {
    CasterCells made = makeCasterCells(surface, *surface.triangles());
    const std::size_t bytes = bytesIn(made.cells);
    return cells_.insert(key, surface, std::move(made), bytes);
  }
  const CurvatureMap& map = maps_.get(surface, parameters, [&] { return CurvatureMap(surface, parameters); });
  CasterCells made = makeCasterCells(surface, parameters, map);
  const std::size_t bytes = bytesIn(made.cells);
  return cells_.insert(key, surface, std::move(made), bytes);
}

std::shared_ptr<const LightGrid> CasterCache::grid(const Surface& surface, std::span<const double> parameters,
                                                   const Vec4& light, int size) {
  const Key key{.shape = Shape(surface, parameters), .light = light, .size = size};
  if (auto known = grids_.find(key)) return known;
  const auto caster = cells(surface, parameters);
  LightGrid made = makeLightGrid(*caster, light, kGridMargin * caster->size, size);
  const std::size_t bytes = bytesIn(made.starts, made.entries);
  return grids_.insert(key, surface, std::move(made), bytes);
}

const std::optional<CasterEquation>& CasterCache::equation(const Surface& surface,
                                                           std::span<const double> parameters) {
  return equations_.get(surface, parameters, [&] { return casterEquation(surface, parameters); });
}

double CasterCache::rounding(const Surface& surface, std::span<const double> parameters) {
  return roundings_.get(surface, parameters, [&] { return formulaRounding(surface, parameters); });
}

}  // namespace luxo
