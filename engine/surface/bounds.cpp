// SPDX-License-Identifier: Apache-2.0
#include "surface/bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <queue>
#include <vector>

#include "surface/spread.h"

namespace luxo {
namespace {

constexpr double kTightEnough = 1.1;
/// Part of its range by which a guard may seem to pass through 0 only because bounds are rounded outward.
constexpr double kGuardRounding = 1e-12;
/// A step across the cell's edge that tells a jump from a steep slope.
constexpr double kJumpStep = 0x1p-30;
constexpr double kJump = 1e-4;  // of the cell's own size

double PartialBounds::*const kPartials[] = {&PartialBounds::uu, &PartialBounds::uv, &PartialBounds::vv};

/// Upper end of the Euclidean length of the three intervals that start at `first`.
double lengthBound(const std::array<Interval, 9>& p, std::size_t first) {
  return sqrt(square(p[first]) + square(p[first + 1]) + square(p[first + 2])).hi;
}

double boundLength(const SurfaceFunction& function, double PartialBounds::*which, const Domain& domain,
                   std::span<const double> inputs, int rectangles) {
  struct Rectangle {
    double bound;
    Domain domain;
    bool operator<(const Rectangle& other) const { return bound < other.bound; }
  };
  double taken = 0;  // a length that is really reached somewhere
  std::priority_queue<Rectangle> open;
  const auto look = [&](const Domain& d) {
    const double middle = boundSecond(function, {d.u.mid(), d.v.mid()}, inputs).*which;
    if (std::isfinite(middle)) taken = std::max(taken, middle);
    open.push({boundSecond(function, d, inputs).*which, d});
  };
  look(domain);
  for (int seen = 1; seen < rectangles && open.top().bound > kTightEnough * taken; ++seen) {
    const Domain d = open.top().domain;
    open.pop();
    // Split the side that is the larger part of the whole domain's; never one of no width.
    if (d.u.width() * domain.v.width() > d.v.width() * domain.u.width()) {
      look({{d.u.lo, d.u.mid()}, d.v});
      look({{d.u.mid(), d.u.hi}, d.v});
    } else {
      look({d.u, {d.v.lo, d.v.mid()}});
      look({d.u, {d.v.mid(), d.v.hi}});
    }
  }
  return open.top().bound;
}

Box boxOf(const std::array<Interval, 3>& p) {
  return {{p[0].lo, p[1].lo, p[2].lo}, {p[0].hi, p[1].hi, p[2].hi}};
}

/// How a guard meets its critical values (0, or the integers) over a cell.
enum class Meeting { None, Touches, Passes };

Meeting meeting(const Interval& guard, bool atIntegers) {
  const double slack = kGuardRounding * guard.magnitude();
  if (!(slack < std::numeric_limits<double>::infinity())) return Meeting::Passes;
  if (atIntegers) {
    if (std::floor(guard.lo + slack) == std::floor(guard.hi - slack) && guard.lo + slack <= guard.hi - slack)
      return std::floor(guard.lo - slack) == std::floor(guard.hi + slack) ? Meeting::None : Meeting::Touches;
    return std::floor(guard.lo - slack) == std::floor(guard.hi + slack) ? Meeting::None : Meeting::Passes;
  }
  if (guard.lo > slack || guard.hi < -slack) return Meeting::None;
  return guard.lo < -slack && guard.hi > slack ? Meeting::Passes : Meeting::Touches;
}

/// Whether the formula jumps on the cell's edge: the values on it are not those just inside.
bool jumpsAtEdge(const SurfaceFunction& function, const Domain& cell, std::span<const double> inputs) {
  constexpr std::array kParts{0.0, 0.2763, 0.5, 0.7639, 1.0};
  std::vector<double> us, vs;
  for (const double part : kParts)
    for (const Side side : kSides) {
      const EdgePoint p = edgePoint(cell, side, part);
      us.insert(us.end(), {p.u, p.u + kJumpStep * (cell.u.mid() - p.u)});
      vs.insert(vs.end(), {p.v, p.v + kJumpStep * (cell.v.mid() - p.v)});
    }
  const auto s = function.position.evaluate(us, vs, inputs);
  const auto at = [&](std::size_t i) { return Vec3(s[0][i], s[1][i], s[2][i]); };
  double size = 0;
  for (std::size_t i = 1; i < us.size(); i += 2) size = std::max(size, glm::length(at(i) - at(1)));
  for (std::size_t i = 0; i < us.size(); i += 2)
    if (!(glm::length(at(i) - at(i + 1)) <= kJump * size)) return true;
  return false;
}

}  // namespace

Box boundPosition(const SurfaceFunction& function, const Domain& cell, std::span<const double> inputs,
                  double farthest) {
  if (function.bounder.position) return function.bounder.position(cell.u, cell.v, inputs);
  std::array<Interval, 3> p;
  function.position.bound(cell.u, cell.v, inputs, p);
  const Box box = boxOf(p);
  if (isFinite(box)) return box;
  std::array<PartialInterval, 3> parts;
  function.position.boundWhereDefined(cell.u, cell.v, inputs, parts);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::optional<Interval> near = parts[i].within(farthest);
    if (!near) return {};
    p[i] = *near;
  }
  return boxOf(p);
}

bool definedAllOver(const SurfaceFunction& function, const Domain& cell, std::span<const double> inputs) {
  if (function.bounder.position) return true;
  std::array<Interval, 3> p;
  function.position.bound(cell.u, cell.v, inputs, p);
  return isFinite(boxOf(p));
}

Box boundPosition(const SurfaceFunction& function, const Domain& domain, std::span<const double> inputs,
                  int cells) {
  const auto part = [cells](const Interval& range, int i) {
    const double step = range.width() / cells;
    return Interval(range.lo + i * step, i + 1 == cells ? range.hi : range.lo + (i + 1) * step);
  };
  Box box;
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i)
      box.add(boundPosition(function, {part(domain.u, i), part(domain.v, j)}, inputs));
  return box;
}

PartialBounds boundSecond(const SurfaceFunction& function, const Domain& cell,
                          std::span<const double> inputs) {
  if (function.bounder.second) {
    const std::array<double, 3> bounds = function.bounder.second(cell.u, cell.v, inputs);
    return {bounds[0], bounds[1], bounds[2]};
  }
  std::array<Interval, 9> p;
  function.second.bound(cell.u, cell.v, inputs, p);
  return {lengthBound(p, 0), lengthBound(p, 3), lengthBound(p, 6)};
}

SecondBounds boundSecondBoxes(const SurfaceFunction& function, const Domain& cell,
                              std::span<const double> inputs) {
  if (function.bounder.secondBoxes) return function.bounder.secondBoxes(cell.u, cell.v, inputs);
  std::array<Interval, 9> p;
  function.second.bound(cell.u, cell.v, inputs, p);
  return {boxOf({p[0], p[1], p[2]}), boxOf({p[3], p[4], p[5]}), boxOf({p[6], p[7], p[8]})};
}

bool mayBeKinked(const SurfaceFunction& function, const Domain& cell, std::span<const double> inputs) {
  const std::size_t count = function.guardAtIntegers.size();
  if (count == 0) return false;
  std::vector<Interval> guards(count);
  function.guards.bound(cell.u, cell.v, inputs, guards);
  bool touches = false;
  for (std::size_t k = 0; k < count; ++k) {
    const Meeting meets = meeting(guards[k], function.guardAtIntegers[k]);
    if (meets == Meeting::Passes) return true;
    touches = touches || meets == Meeting::Touches;
  }
  return touches && jumpsAtEdge(function, cell, inputs);
}

PartialBounds boundPartials(const SurfaceFunction& function, const Domain& domain,
                            std::span<const double> inputs, int rectangles) {
  PartialBounds bounds;
  const bool kinked = mayBeKinked(function, domain, inputs);
  for (const auto which : kPartials)
    bounds.*which = kinked ? std::numeric_limits<double>::infinity()
                           : boundLength(function, which, domain, inputs, rectangles);
  return bounds;
}

}  // namespace luxo
