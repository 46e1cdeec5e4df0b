// SPDX-License-Identifier: Apache-2.0
#include "shadow/caster_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "surface/equation.h"
#include "surface/formula_rounding.h"
#include "surface/spread.h"
#include "surface/surface_triangles.h"

namespace luxo {
namespace {

/// Of a cell's size: what evaluations round away.
constexpr double kRounding = 1e-14;
/// Halvings of a patch, both ways together.
constexpr std::uint32_t kMaxLevels = 32;
/// Of a cell's sides, to prove which way it bends. Measured, of the teapot's pixels whose shadows rays found
/// as the light grazes what is convex: 111 need none, 205 two, 20 four.
constexpr int kBendHalvings = 2;

/// The same bounds as the map's, of the tile that holds a smaller one.
const Curvature& boundOf(const CurvatureMap& map, std::uint32_t patch, Tile tile) {
  for (; tile.levelU > map.levelU(); --tile.levelU) tile.column /= 2;
  for (; tile.levelV > map.levelV(); --tile.levelV) tile.row /= 2;
  return map.over(patch, tile);
}

class Cutter {
 public:
  Cutter(const Surface& surface, std::span<const double> parameters, const CurvatureMap& map)
      : surface_(surface), parameters_(parameters), map_(map) {}

  CasterCells cut() {
    const Box framing = surface_.framing(parameters_);
    CasterCells made{.size = framing.empty() ? 0 : glm::length(framing.extent()),
                     .flatNormal = surface_.flatNormal(),
                     .convex = isEllipsoid(surface_, parameters_)};
    size_ = made.size;
    for (std::uint32_t patch = 0; patch < surface_.patchCount(); ++patch) add(patch, {});
    while (!open_.empty() && open_.size() + done_.size() < kMaxCasterCells) {
      std::ranges::pop_heap(open_, {}, &Part::excess);
      const Part part = std::move(open_.back());
      open_.pop_back();
      for (const Tile& half : part.tile.halves(part.acrossU)) add(part.cell.patch, half);
    }
    for (Part& part : open_) done_.push_back(std::move(part.cell));
    made.cells = std::move(done_);
    // No point of a convex one, or of a plane, that faces a light is in its own shadow. What changes with its
    // parameters is cut again in every frame, and has fewer proofs.
    const bool shadowsItself = !made.convex && !made.flatNormal && parameters_.empty();
    for (CasterCell& cell : made.cells) {
      if (shadowsItself && cell.proven()) cell.bendsAway = bendsAway(cell.patch, cell.domain, kBendHalvings);
      made.bounds.add(cell.middle - cell.reach);
      made.bounds.add(cell.middle + cell.reach);
    }
    return made;
  }

 private:
  struct Part {
    CasterCell cell;
    Tile tile;
    double excess = 0;  ///< how many times as large as it should be
    bool acrossU = false;
  };

  void add(std::uint32_t patch, const Tile& tile) {
    Part part = partOf(patch, tile);
    // The formula has no points there.
    if (!isFinite(part.cell.middle) && part.cell.reach == Vec3(0)) return;
    if (!(part.excess > 1)) {
      done_.push_back(std::move(part.cell));
      return;
    }
    open_.push_back(std::move(part));
    std::ranges::push_heap(open_, {}, &Part::excess);
  }

  Part partOf(std::uint32_t patch, const Tile& tile) const {
    const Domain& whole = surface_.patchDomain(patch);
    const Curvature& c = boundOf(map_, patch, tile);
    Part part{.cell = {.patch = patch, .domain = domainOf(tile, whole)}, .tile = tile};
    CasterCell& cell = part.cell;
    const double hu = 0.5 * cell.domain.u.width(), hv = 0.5 * cell.domain.v.width();
    const double u = cell.domain.u.lo + hu, v = cell.domain.v.lo + hv;
    const SurfacePoints at = surface_.evaluate(patch, {&u, 1}, {&v, 1}, parameters_);
    cell.middle = at.position[0];
    cell.a = hu * at.du[0];
    cell.b = hv * at.dv[0];
    const double perU = 1 / whole.u.width(), perV = 1 / whole.v.width();
    cell.uu = c.uu * perU * perU;
    cell.uv = c.mixed * perU * perV;
    cell.vv = c.vv * perV * perV;
    cell.bend = 0.5 * (cell.uu * hu * hu + 2 * cell.uv * hu * hv + cell.vv * hv * hv);
    const double lengthU = 2 * glm::length(cell.a), lengthV = 2 * glm::length(cell.b);
    if (cell.proven()) {
      cell.bend += kRounding * (size_ + glm::length(cell.middle));
      cell.reach = glm::abs(cell.a) + glm::abs(cell.b) + cell.bend;
      part.excess = std::max({cell.bend / (kCellBend * size_), lengthU / (kCellLength * size_),
                              lengthV / (kCellLength * size_)});
      part.acrossU =
          lengthU + cell.uu * hu * hu + cell.uv * hu * hv >= lengthV + cell.vv * hv * hv + cell.uv * hu * hv;
    } else {
      boundUnproven(cell);
      part.excess = kInfinity;
      part.acrossU = tile.levelU <= tile.levelV;
    }
    const bool deepest = cell.proven() ? tile.levelU + tile.levelV >= kMaxLevels
                                       : tile.levelU >= map_.levelU() && tile.levelV >= map_.levelV();
    if (deepest || !(size_ > 0)) part.excess = 0;
    return part;
  }

  /// Of a rectangle, or of all its quarters.
  int bendsAway(std::uint32_t patch, const Domain& d, int halvings) const {
    const int whole = surface_.bendsAwayFrom(patch, d, parameters_);
    if (whole != 0 || halvings == 0) return whole;
    const double u = d.u.mid(), v = d.v.mid();
    const int first = bendsAway(patch, {{d.u.lo, u}, {d.v.lo, v}}, halvings - 1);
    for (const Domain& quarter :
         {Domain{{u, d.u.hi}, {d.v.lo, v}}, {{d.u.lo, u}, {v, d.v.hi}}, {{u, d.u.hi}, {v, d.v.hi}}})
      if (first == 0 || bendsAway(patch, quarter, halvings - 1) != first) return 0;
    return first;
  }

  /// By the box that intervals give.
  void boundUnproven(CasterCell& cell) const {
    const Box box = surface_.boundPosition(cell.patch, cell.domain, parameters_);
    cell.bend = kInfinity;
    cell.a = cell.b = Vec3(0);
    if (box.empty()) {
      cell.middle = Vec3(kInfinity);
      cell.reach = Vec3(0);
    } else if (isFinite(box)) {
      cell.middle = box.center();
      cell.reach = 0.5 * box.extent() * (1 + kRounding);
    } else {
      cell.middle = Vec3(0);
      cell.reach = Vec3(kInfinity);
    }
  }

  const Surface& surface_;
  std::span<const double> parameters_;
  const CurvatureMap& map_;
  double size_ = 0;
  std::vector<Part> open_;  ///< a heap: the largest excess first
  std::vector<CasterCell> done_;
};

}  // namespace

bool isEllipsoid(const Surface& surface, std::span<const double> parameters) {
  if (surface.patchCount() != 1) return false;
  const auto equation = equationOf(surface, 0, parameters);
  return equation && equation->form() == Equation::Form::Quadric && boundsSolid(surface, parameters);
}

bool CasterCell::proven() const {
  return std::isfinite(bend) && isFinite(middle) && isFinite(a) && isFinite(b);
}

CasterCells makeCasterCells(const Surface& surface, const SurfaceTriangles& triangles) {
  CasterCells made{.bounds = surface.bounds({}),
                   .size = glm::length(surface.bounds({}).extent()),
                   .flatNormal = surface.flatNormal()};
  made.cells.reserve(triangles.count);
  for (std::uint32_t i = 0; i < triangles.count; ++i) {
    Box box;
    for (const Vec3& point : triangles.points(i)) box.add(point);
    CasterCell& cell = made.cells.emplace_back(CasterCell{.patch = i, .middle = box.center()});
    cell.reach = 0.5 * box.extent() + kRounding * (made.size + glm::length(cell.middle));
    cell.bend = std::numeric_limits<double>::infinity();  // the box says it all
  }
  return made;
}

CasterCells makeCasterCells(const Surface& surface, std::span<const double> parameters,
                            const CurvatureMap& map) {
  CasterCells made = Cutter(surface, parameters, map).cut();
  made.rounding = formulaRounding(surface, parameters);
  return made;
}

}  // namespace luxo
