// SPDX-License-Identifier: Apache-2.0
#include "surface/bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>

namespace luxo {
namespace {

constexpr int kPositionCells = 16;
constexpr int kMostRectangles = 512;
constexpr double kTightEnough = 1.1;

/// Upper end of the Euclidean length, over a rectangle, of the second derivative whose outputs start at
/// `first`.
double lengthBound(const SurfaceFunction& function, std::size_t first, const Domain& d,
                   std::span<const double> parameters) {
  std::array<Interval, 9> p;
  function.second.bound(d.u, d.v, parameters, p);
  return sqrt(square(p[first]) + square(p[first + 1]) + square(p[first + 2])).hi;
}

double boundLength(const SurfaceFunction& function, std::size_t firstOutput, const Domain& domain,
                   std::span<const double> parameters) {
  struct Rectangle {
    double bound;
    Domain domain;
    bool operator<(const Rectangle& other) const { return bound < other.bound; }
  };
  double taken = 0;  // a length that is really reached somewhere
  std::priority_queue<Rectangle> open;
  const auto look = [&](const Domain& d) {
    const double middle = lengthBound(function, firstOutput, {d.u.mid(), d.v.mid()}, parameters);
    if (std::isfinite(middle)) taken = std::max(taken, middle);
    open.push({lengthBound(function, firstOutput, d, parameters), d});
  };
  look(domain);
  for (int seen = 1; seen < kMostRectangles && open.top().bound > kTightEnough * taken; ++seen) {
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

}  // namespace

Box boundPosition(const SurfaceFunction& function, const Domain& domain, std::span<const double> parameters) {
  const auto part = [](const Interval& range, int i) {
    const double step = range.width() / kPositionCells;
    return Interval(range.lo + i * step, i + 1 == kPositionCells ? range.hi : range.lo + (i + 1) * step);
  };
  Box box;
  for (int j = 0; j < kPositionCells; ++j)
    for (int i = 0; i < kPositionCells; ++i) {
      std::array<Interval, 3> p;
      function.position.bound(part(domain.u, i), part(domain.v, j), parameters, p);
      box.add(Vec3(p[0].lo, p[1].lo, p[2].lo));
      box.add(Vec3(p[0].hi, p[1].hi, p[2].hi));
    }
  return box;
}

PartialBounds boundPartials(const SurfaceFunction& function, const Domain& domain,
                            std::span<const double> parameters) {
  return {boundLength(function, 0, domain, parameters), boundLength(function, 3, domain, parameters),
          boundLength(function, 6, domain, parameters)};
}

}  // namespace luxo
