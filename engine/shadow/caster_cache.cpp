// SPDX-License-Identifier: Apache-2.0
#include "shadow/caster_cache.h"

namespace luxo {

std::shared_ptr<const CasterCells> CasterCache::cells(const Surface& surface,
                                                      std::span<const double> parameters,
                                                      const std::vector<std::uint32_t>& patches) {
  const Key key{.shape = Shape(surface, parameters), .firstPatch = patches.front()};
  if (auto known = cells_.find(key)) return known;
  const CurvatureMap& map = maps_.get(surface, parameters, [&] { return CurvatureMap(surface, parameters); });
  CasterCells made = makeCasterCells(surface, parameters, patches, map);
  const std::size_t bytes = bytesIn(made.cells);
  return cells_.insert(key, surface, std::move(made), bytes);
}

std::shared_ptr<const LightGrid> CasterCache::grid(const Surface& surface, std::span<const double> parameters,
                                                   const std::vector<std::uint32_t>& patches,
                                                   const Vec4& light, int size) {
  const Key key{
      .shape = Shape(surface, parameters), .firstPatch = patches.front(), .light = light, .size = size};
  if (auto known = grids_.find(key)) return known;
  const auto caster = cells(surface, parameters, patches);
  LightGrid made = makeLightGrid(*caster, light, kGridMargin * caster->size, size);
  const std::size_t bytes = bytesIn(made.starts, made.entries);
  return grids_.insert(key, surface, std::move(made), bytes);
}

}  // namespace luxo
