// SPDX-License-Identifier: Apache-2.0
#include "reference/cell_tree.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "surface/bounds.h"

namespace luxo::reference {
namespace {

constexpr double kMargin = 1e-6;           // of the domain, on every side
constexpr double kFineEnough = 1.0 / 512;  // of the surface's size
/// Sizes: what a pole reaches beyond is as thin as a millionth of them.
constexpr double kEndless = 1e6;
constexpr std::size_t kWorthAThread = 512;  // cells

Enclosure enclose(const Interval& x, const Interval& y, const Interval& z) {
  Enclosure e;
  const Interval* const parts[3] = {&x, &y, &z};
  for (int i = 0; i < 3; ++i) {
    e.center[i] = parts[i]->mid();
    // The middle is rounded: whatever it has become, both ends are within the radius.
    e.radius[i] = std::max(parts[i]->hi - e.center[i], e.center[i] - parts[i]->lo) * (1 + kEpsilon);
    if (!std::isfinite(e.radius[i])) e.center[i] = 0, e.radius[i] = std::numeric_limits<double>::infinity();
  }
  return e;
}

Enclosure enclose(std::span<const Interval> outputs, std::size_t first) {
  return enclose(outputs[first], outputs[first + 1], outputs[first + 2]);
}

Enclosure enclose(const Box& b) {
  return enclose(Interval(b.min.x, b.max.x), Interval(b.min.y, b.max.y), Interval(b.min.z, b.max.z));
}

/// Of a cell whose points are all within `reach` of the middle's: the smaller ball.
void sharpen(Enclosure& all, const Enclosure& middle, double reach) {
  const Vec3 radius = (middle.radius + reach) * (1 + 8 * kEpsilon);
  if (glm::length(radius) < glm::length(all.radius)) all = {middle.center, radius};
}

Domain extend(const Domain& d) {
  const double u = kMargin * d.u.width(), v = kMargin * d.v.width();
  return {{d.u.lo - u, d.u.hi + u}, {d.v.lo - v, d.v.hi + v}};
}

/// How far the cell is from its own linear approximation, at most.
double bending(const CellBounds& b, const Domain& d) {
  const double excess = glm::length(b.du.radius) * d.u.width() + glm::length(b.dv.radius) * d.v.width();
  return b.smooth && std::isfinite(excess) ? excess : 2 * glm::length(b.position.radius);
}

}  // namespace

Halves halvesInU(const Domain& d) { return {{{{d.u.lo, d.u.mid()}, d.v}, {{d.u.mid(), d.u.hi}, d.v}}}; }
Halves halvesInV(const Domain& d) { return {{{d.u, {d.v.lo, d.v.mid()}}, {d.u, {d.v.mid(), d.v.hi}}}}; }

Halves halves(const Cell& cell, const Domain& whole) {
  const Domain& d = cell.domain;
  const CellBounds& b = cell.bounds;
  const double alongU = glm::length(b.du.center) * d.u.width();
  const double alongV = glm::length(b.dv.center) * d.v.width();
  const double bendU = glm::length(b.du.radius) * d.u.width();
  const double bendV = glm::length(b.dv.radius) * d.v.width();
  const bool splitU = b.smooth && alongU + alongV > 0
                          ? alongU + bendU >= alongV + bendV
                          : d.u.width() * whole.v.width() >= d.v.width() * whole.u.width();
  return splitU ? halvesInU(d) : halvesInV(d);
}

bool Enclosure::finite() const {
  for (int i = 0; i < 3; ++i)
    if (!std::isfinite(center[i]) || !std::isfinite(radius[i])) return false;
  return true;
}

BoundedPatch::BoundedPatch(const Surface& surface, std::uint32_t patch, std::span<const double> parameters,
                           double farthest)
    : function_(surface.patches()[patch].function.get()),
      values_(surface.patches()[patch].constants),
      domain_(surface.patches()[patch].domain),
      extended_(extend(domain_)),
      farthest_(farthest) {
  values_.insert(values_.end(), parameters.begin(), parameters.end());
}

CellBounds BoundedPatch::bound(const Domain& cell) const {
  CellBounds bounds = function_->bounder.tangents ? boundByFamily(cell) : boundByIntervals(cell);
  if (!bounds.smooth) return bounds;
  // The mean value form is the sharper one on small cells.
  const double hu = 0.5 * cell.u.width() * (1 + 4 * kEpsilon), hv = 0.5 * cell.v.width() * (1 + 4 * kEpsilon);
  const Vec3 reach = bounds.middle.radius + (glm::abs(bounds.du.center) + bounds.du.radius) * hu +
                     (glm::abs(bounds.dv.center) + bounds.dv.radius) * hv;
  if (!bounds.position.finite() || glm::length(reach) < glm::length(bounds.position.radius))
    bounds.position = {bounds.middle.center, reach * (1 + 8 * kEpsilon)};
  return bounds;
}

CellBounds BoundedPatch::boundByFamily(const Domain& cell) const {
  const TangentBounds b = function_->bounder.tangents(cell.u, cell.v, values_);
  return {.position = enclose(b.position),
          .middle = enclose(b.middle),
          .du = enclose(b.du),
          .dv = enclose(b.dv),
          .smooth = true};
}

CellBounds BoundedPatch::boundByIntervals(const Domain& cell) const {
  std::array<Interval, 9> over, middle;
  function_->tangents.bound(cell.u, cell.v, values_, over);
  function_->tangents.bound(cell.u.mid(), cell.v.mid(), values_, middle);
  CellBounds bounds{.position = enclose(over, 0),
                    .middle = enclose(middle, 0),
                    .du = enclose(over, 3),
                    .dv = enclose(over, 6)};
  if (!bounds.position.finite()) {
    const Box box = boundPosition(*function_, cell, values_, farthest_);
    bounds.empty = box.empty();
    if (!bounds.empty) bounds.position = enclose(box);
  }
  bounds.smooth = bounds.du.finite() && bounds.dv.finite() && bounds.middle.finite() &&
                  !mayBeKinked(*function_, cell, values_);
  if (bounds.smooth && function_->bounder.second) {
    const double hu = 0.5 * cell.u.width() * (1 + 4 * kEpsilon),
                 hv = 0.5 * cell.v.width() * (1 + 4 * kEpsilon);
    const auto [uu, uv, vv] = function_->bounder.second(cell.u, cell.v, values_);
    sharpen(bounds.du, enclose(middle, 3), uu * hu + uv * hv);
    sharpen(bounds.dv, enclose(middle, 6), uv * hu + vv * hv);
  }
  return bounds;
}

BoundedPatch::Point BoundedPatch::at(double u, double v) const {
  std::array<double, 9> p;
  function_->tangents.evaluatePoint(u, v, values_, p);
  return {{p[0], p[1], p[2]}, {p[3], p[4], p[5]}, {p[6], p[7], p[8]}};
}

CellTree::CellTree(const Surface& surface, std::span<const double> parameters, std::size_t mostCells)
    : surface_(surface),
      parameters_(parameters.begin(), parameters.end()),
      size_(glm::length(surface.framing(parameters).extent())) {
  const Box framing = surface_.framing(parameters_);
  const double farthest =
      framing.empty()
          ? 0
          : glm::length(glm::max(glm::abs(framing.min), glm::abs(framing.max))) + kEndless * size_;
  for (std::uint32_t patch = 0; patch < surface_.patchCount(); ++patch)
    patches_.emplace_back(surface_, patch, parameters_, farthest);
  cut(mostCells);
  if (cells_.empty()) return;
  std::vector<std::uint32_t> all(cells_.size());
  std::iota(all.begin(), all.end(), 0U);
  nodes_.resize(2 * all.size() - 1);
  build(all, 0);
}

void CellTree::cut(std::size_t mostCells) {
  const double fine = kFineEnough * size_;
  // Of every round: what is cut no further goes to cells_, what was cut in two to the next round.
  std::vector<Cell> open;
  for (std::uint32_t patch = 0; patch < patches_.size(); ++patch) {
    const Domain& whole = patches_[patch].extended();
    open.push_back({patch, whole, patches_[patch].bound(whole)});
  }
  while (!open.empty()) {
    const auto bends = [](const Cell& cell) { return bending(cell.bounds, cell.domain); };
    std::erase_if(open, [](const Cell& cell) { return cell.bounds.empty; });
    const auto rest = std::stable_partition(open.begin(), open.end(),
                                            [&](const Cell& cell) { return !(bends(cell) <= fine); });
    cells_.insert(cells_.end(), rest, open.end());
    open.erase(rest, open.end());
    const std::size_t room = mostCells - std::min(mostCells, cells_.size() + open.size());
    if (open.size() > room) {
      std::ranges::stable_sort(open, std::greater(), bends);
      cells_.insert(cells_.end(), open.begin() + static_cast<std::ptrdiff_t>(room), open.end());
      open.resize(room);
    }
    std::vector<Cell> next(2 * open.size());
    tbb::parallel_for(std::size_t{0}, open.size(), [&](std::size_t i) {
      const auto [a, b] = halves(open[i], patches_[open[i].patch].extended());
      next[2 * i] = {open[i].patch, a, patches_[open[i].patch].bound(a)};
      next[2 * i + 1] = {open[i].patch, b, patches_[open[i].patch].bound(b)};
    });
    open = std::move(next);
  }
}

void CellTree::build(std::span<std::uint32_t> cells, std::uint32_t index) {
  Vec3 lo(std::numeric_limits<double>::infinity()), hi = -lo, first = lo, last = -lo;
  for (const std::uint32_t c : cells) {
    const Enclosure& e = cells_[c].bounds.position;
    lo = glm::min(lo, e.center - e.radius);
    hi = glm::max(hi, e.center + e.radius);
    first = glm::min(first, e.center);
    last = glm::max(last, e.center);
  }
  nodes_[index].center = 0.5 * (lo + hi);
  nodes_[index].half = glm::max(hi - nodes_[index].center, nodes_[index].center - lo) * (1 + kEpsilon);
  for (int i = 0; i < 3; ++i)  // an unbounded cell is met by every ray
    if (!std::isfinite(nodes_[index].half[i])) {
      nodes_[index].center[i] = 0;
      nodes_[index].half[i] = std::numeric_limits<double>::infinity();
    }
  if (cells.size() == 1) {
    nodes_[index].cell = cells[0];
    return;
  }
  const Vec3 spread = last - first;
  const int axis = spread.x >= spread.y && spread.x >= spread.z ? 0 : spread.y >= spread.z ? 1 : 2;
  const auto middle = cells.begin() + static_cast<std::ptrdiff_t>(cells.size() / 2);
  std::nth_element(cells.begin(), middle, cells.end(), [&](std::uint32_t a, std::uint32_t b) {
    const double x = cells_[a].bounds.position.center[axis], y = cells_[b].bounds.position.center[axis];
    return x < y || (x == y && a < b);
  });
  // n cells make 2 n - 1 nodes.
  const auto lower = cells.first(cells.size() / 2), upper = cells.subspan(cells.size() / 2);
  const auto second = index + 2 * static_cast<std::uint32_t>(lower.size());
  nodes_[index].second = second;
  if (cells.size() < kWorthAThread) {
    build(lower, index + 1);
    build(upper, second);
  } else {
    tbb::parallel_invoke([&] { build(lower, index + 1); }, [&] { build(upper, second); });
  }
}

}  // namespace luxo::reference
