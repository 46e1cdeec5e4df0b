// SPDX-License-Identifier: Apache-2.0
#include "shadow/caster_cache.h"

namespace luxo {

std::optional<CasterEquation> casterEquation(const Surface& surface, std::span<const double> parameters) {
  const auto inUnits = [&](const Equation& equation, std::uint32_t patch) {
    const Box edges = equation.edgesOf(surface.patchDomain(patch));
    return Box{edges.min / equation.scale, edges.max / equation.scale};
  };
  if (surface.patchCount() == 0 || surface.patchCount() > 2) return std::nullopt;
  const std::optional<Equation> first = equationOf(surface, 0, parameters);
  if (!first) return std::nullopt;
  CasterEquation caster{*first, inUnits(*first, 0), first->v.along == Equation::Along::Latitude};
  if (surface.patchCount() == 1) return caster;
  // Points of either sheet are where the one F is zero.
  const std::optional<Equation> second = equationOf(surface, 1, parameters);
  if (!second || first->sheet * second->sheet >= 0 || first->scale != second->scale ||
      first->xx != second->xx)
    return std::nullopt;
  caster.edges.add(inUnits(*second, 1));
  caster.equation.sheet = 0;
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

}  // namespace luxo
