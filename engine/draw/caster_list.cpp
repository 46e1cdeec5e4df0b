// SPDX-License-Identifier: Apache-2.0
#include "draw/caster_list.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "draw/paint.h"
#include "math/transform.h"
#include "shared/scene_data.h"
#include "surface/surface_triangles.h"

namespace luxo {

static_assert(kTriangleNumbers == shared::kTriangleNumbers);

namespace {

/// Of the distances involved: what a dozen operations of single precision round away.
constexpr double kRounding = 0x1p-21;
/// Of parameters: what single precision leaves of a rectangle's middle, and of those of its halves. Without
/// it there were gaps between cells at many turns of a coil.
constexpr double kParameterRounding = 0x1p-22;
constexpr float kUp = 1 + 0x1p-22F;  ///< a float that is rounded down is no bound

/// How far a surface's points would move if its parameters, as shaders have them, were as large again, at
/// most.
double spanOfParameters(const Surface& surface, const CasterCells& cells) {
  double span = 0;
  for (const CasterCell& cell : cells.cells) {
    if (!cell.proven()) continue;
    const Patch& patch = surface.patches()[cell.patch];
    const double origin = patch.general ? 0 : patch.originOfU();
    const auto largest = [](const Interval& range, double from) {
      return std::max(std::abs(range.lo - from), std::abs(range.hi - from)) / range.width();
    };
    span = std::max(span, 2 * (glm::length(cell.a) * largest(cell.domain.u, origin) +
                               glm::length(cell.b) * largest(cell.domain.v, 0)));
  }
  return span;
}

}  // namespace

CasterList::CasterList(const Snapshot& snapshot, Geometry& geometry, DrawList& list)
    : snapshot_(snapshot), geometry_(geometry), list_(list) {
  auto entries =
      static_cast<std::size_t>(std::ranges::count_if(snapshot.nodes, [&](const SnapshotNode& node) {
        return snapshot.materials[node.material.index].transparent();
      }));
  for (const SnapshotLight& light : snapshot.lights) entries += light.casters.size();
  share_ = kMaxCasterBytes / std::max<std::size_t>(entries, 1);
}

std::optional<CasterList::Entry> CasterList::entryOf(const SnapshotNode& node, const CasterCode& found,
                                                     const Vec4& from, int gridSize) {
  const Mat3& linear = node.worldFromObject.linear;
  const Mat3 inverse = glm::inverse(linear);
  const bool invertible = isFinite(inverse[0]) && isFinite(inverse[1]) && isFinite(inverse[2]);
  if (!isFinite(node.boundsObject) || !invertible || found.code->isTooLarge()) return std::nullopt;
  const SurfaceTriangles* triangles = node.surface.triangles();
  if (triangles && triangles->count > kMaxCasterTriangles) return std::nullopt;
  Entry entry{.caster = {}, .cells = geometry_.casters.cells(node.surface, node.parameters)};
  const CasterCells& cells = *entry.cells;
  if (cells.cells.empty()) return entry;
  if (!cells.finite()) return std::nullopt;
  const Vec3 toward = Vec3(from) - from.w * node.worldFromObject.translation;
  const Vec4 fromObject(inverse * toward, from.w);
  // About a triangle a texel, where there are many.
  const int size = triangles ? std::max(gridSize, static_cast<int>(std::sqrt(triangles->count))) : gridSize;
  const auto grid = gridThatFits(node, fromObject, size);

  const std::uint32_t ofTriangle =
      shared::kTriangleNumbers + (readsParameters(node) ? 3 * shared::kCornerParameters : 0);
  const Vec3 origin = inverse * (list_.origin - node.worldFromObject.translation);
  const Vec3 farthest = glm::max(glm::abs(cells.bounds.min), glm::abs(cells.bounds.max));
  Casters& all = list_.casters;
  const auto fits = [](const auto& held, std::size_t more) {
    return (held.size() + more) * sizeof(held[0]) <= kMaxCasterBytes;
  };
  if (!fits(all.gridStarts, grid->starts.size()) || !fits(all.gridEntries, grid->entries.size()) ||
      !fits(all.cells, triangles ? triangles->count : cells.cells.size()) ||
      !fits(all.parameters, triangles ? std::size_t{ofTriangle} * triangles->count : 0))
    return std::nullopt;
  const Place& place = placeOf(entry.cells, node, found);
  shared::ShadowCaster& caster = entry.caster.emplace(shared::ShadowCaster{
      .gridFromRelative = Mat3f(grid->axes * inverse),
      .gridOrigin = Vec3f(grid->fromLight(origin)),
      .objectFromRelative = Mat3f(inverse),
      .objectOrigin = Vec3f(origin),
      .lightObject = Vec4f(fromObject),
      .lightRelative = Vec4f(Vec3f(Vec3(from) - from.w * list_.origin), from.w),
      .gridSize = static_cast<std::uint32_t>(grid->size),
      .firstEntry = static_cast<std::uint32_t>(all.gridEntries.size()),
      .firstCell = place.firstCell,
      .firstParameter = place.firstParameter,
      .parameters = triangles ? ofTriangle : static_cast<std::uint32_t>(found.parameters[0].size()),
      .flags = from.w == 0 ? shared::kParallelLight : 0,
      .rounding = static_cast<float>(std::max(kRounding * (glm::length(origin) + glm::length(farthest)),
                                              cells.rounding * kTimesMeasured) +
                                     kParameterRounding * spanOfParameters(node.surface, cells)),
      .roundingPerMetre = static_cast<float>(kRounding * largestStretch(inverse)),
      .margin = static_cast<float>(kGridMargin * cells.size),
      .pixel = static_cast<float>(1 / (snapshot_.view.pixelsPerUnit * largestStretch(linear)))});
  const auto firstStart = static_cast<std::uint32_t>(all.gridStarts.size());
  for (std::size_t i = 0; i < grid->faces.size(); ++i) {
    const LightGrid::Face& face = grid->faces[i];
    caster.faces[i] = Vec4f(Vec4(face.low, face.texels));
    caster.firstTexel[i] = firstStart + face.first;
  }
  all.gridStarts.insert(all.gridStarts.end(), grid->starts.begin(), grid->starts.end());
  for (const LightGrid::Entry& listed : grid->entries)
    all.gridEntries.push_back({listed.cell, listed.nearest});
  return entry;
}

bool CasterList::losesMore(const SnapshotNode& node) {
  const auto cells = geometry_.casters.cells(node.surface, node.parameters);
  const Vec3 origin =
      glm::inverse(node.worldFromObject.linear) * (list_.origin - node.worldFromObject.translation);
  const Vec3 farthest = glm::max(glm::abs(cells->bounds.min), glm::abs(cells->bounds.max));
  return cells->rounding > kRounding * (glm::length(origin) + glm::length(farthest));
}

double CasterList::roundingOfPlaces(const SnapshotNode& node) {
  const Transform& place = node.worldFromObject;
  const Box bounds = isFinite(node.boundsObject) ? node.boundsObject : node.surface.framing(node.parameters);
  const Vec3 farthest = glm::max(glm::abs(bounds.min), glm::abs(bounds.max));
  const double formula = geometry_.casters.rounding(node.surface, node.parameters) * kTimesMeasured;
  return largestStretch(place.linear) * std::max(kRounding * glm::length(farthest), formula) +
         kRounding * glm::distance(place.translation, list_.origin);
}

std::shared_ptr<const LightGrid> CasterList::gridThatFits(const SnapshotNode& node, const Vec4& fromObject,
                                                          int gridSize) {
  // With fewer texels than that lists are too long to be walked: rays are faster.
  constexpr int kLeast = 8;
  for (;; gridSize = std::max(gridSize / 2, kLeast)) {
    auto grid = geometry_.casters.grid(node.surface, node.parameters, fromObject, gridSize);
    if (gridSize <= kLeast || std::max(grid->starts.size() * sizeof(grid->starts[0]),
                                       grid->entries.size() * sizeof(grid->entries[0])) <= share_)
      return grid;
  }
}

const CasterList::Place& CasterList::placeOf(const std::shared_ptr<const CasterCells>& cells,
                                             const SnapshotNode& node, const CasterCode& found) {
  Casters& all = list_.casters;
  const SurfaceTriangles* triangles = node.surface.triangles();
  const bool withParameters = triangles && readsParameters(node);
  const auto [entry, isNew] = places_.try_emplace({cells.get(), withParameters},
                                                  Place{cells, static_cast<std::uint32_t>(all.cells.size()),
                                                        static_cast<std::uint32_t>(all.parameters.size())});
  if (!isNew) return entry->second;
  if (triangles) {
    addTriangles(*triangles, withParameters);
  } else {
    addCells(*cells, node.surface);
    for (const std::vector<double>& parameters : found.parameters)
      all.parameters.insert(all.parameters.end(), parameters.begin(), parameters.end());
  }
  return entry->second;
}

bool CasterList::readsParameters(const SnapshotNode& node) const {
  return Paint::ofCaster(snapshot_.materials[node.material.index]).valid();
}

void CasterList::addTriangles(const SurfaceTriangles& triangles, bool parameters) {
  std::vector<float>& numbers = list_.casters.parameters;
  const std::span<const Vec2f> uvs = triangles.mesh.uvs();
  for (std::uint32_t i = 0; i < triangles.count; ++i) {
    list_.casters.cells.push_back({.bend = Vec3f(0), .patch_ = i});
    for (const Vec3& point : triangles.points(i)) numbers.insert(numbers.end(), &point[0], &point[0] + 3);
    if (!parameters) continue;
    for (const std::uint32_t corner : triangles.corners(i)) {
      const Vec2f uv = uvs.empty() ? Vec2f(0) : uvs[corner];
      numbers.insert(numbers.end(), {uv.x, uv.y});
    }
  }
}

std::uint32_t CasterList::add(const shared::ShadowCaster& caster) {
  list_.casters.casters.push_back(caster);
  return static_cast<std::uint32_t>(list_.casters.casters.size() - 1);
}

void CasterList::addCells(const CasterCells& cells, const Surface& surface) {
  for (const CasterCell& cell : cells.cells) {
    const double hu = 0.5 * cell.domain.u.width(), hv = 0.5 * cell.domain.v.width();
    const Patch& of = surface.patches()[cell.patch];
    const double originOfU = of.general ? 0 : of.originOfU();
    list_.casters.cells.push_back({.middle = Vec2f(cell.domain.u.lo - originOfU + hu, cell.domain.v.lo + hv),
                                   .half_ = Vec2f(hu, hv) * kUp,
                                   .bend = cell.proven() ? Vec3f(cell.uu, cell.uv, cell.vv) * kUp : Vec3f(-1),
                                   .patch_ = cell.patch,
                                   .originOfU = static_cast<float>(originOfU),
                                   .outward = static_cast<float>(surface.topology().orientation(cell.patch)),
                                   .bendsAway = static_cast<float>(cell.bendsAway)});
  }
}

std::optional<PixelRect> CasterList::pixelsAround(std::span<const Vec3> points) const {
  const View& view = snapshot_.view;
  const PixelRect all{{0, 0}, {view.size.width, view.size.height}};
  const PixelRows rows = pixelRows(view, {});
  const Vec2 middle(0.5 * view.size.width, 0.5 * view.size.height);
  Vec2 low(std::numeric_limits<double>::infinity()), high = -low;
  for (const Vec3& p : points) {
    const double depth = glm::dot(rows.depth, Vec4(p, 1)), width = view.perspective() ? depth : 1;
    if (view.perspective() && !(depth > view.near)) return all;
    const Vec2 pixel = middle + Vec2(glm::dot(rows.x, Vec4(p, 1)), glm::dot(rows.y, Vec4(p, 1))) / width;
    low = glm::min(low, pixel - 1.0);
    high = glm::max(high, pixel + 1.0);
  }
  const auto within = [](double x, int most) {
    return static_cast<std::int32_t>(std::clamp(x, 0.0, 1.0 * most));
  };
  const PixelRect rect{{within(std::floor(low.x), all.high.x), within(std::floor(low.y), all.high.y)},
                       {within(std::ceil(high.x), all.high.x), within(std::ceil(high.y), all.high.y)}};
  if (rect.low.x >= rect.high.x || rect.low.y >= rect.high.y) return std::nullopt;
  return rect;
}

}  // namespace luxo
