// SPDX-License-Identifier: Apache-2.0
#include "support/brute_force.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace luxo::test {
namespace {

constexpr int kLevels = 13;
constexpr std::size_t kMaxCells = 2000;
constexpr int kProofsPerLevel = 8;  // of points: 13 evaluations each at least, some hundred at most
constexpr int kHalvings = 7;        // of an edge of a rectangle
constexpr double kAround = 2;       // of a rectangle's sides: its neighbours that may hold the point instead
constexpr double kRounding = 1e-13;

using Intervals = std::array<Interval, 3>;

class Prover {
 public:
  Prover(const Surface& surface, std::span<const double> parameters, const Transform& worldFromObject,
         const Vec3& origin, const Vec3& direction, double nearest, double farthest)
      : surface_(surface),
        parameters_(parameters),
        transform_(worldFromObject),
        origin_(origin),
        direction_(direction),
        nearest_(nearest),
        farthest_(farthest) {
    // Two directions across the ray, by Gram and Schmidt.
    const Vec3 size = glm::abs(direction);
    const Vec3 other = size.x <= size.y && size.x <= size.z ? Vec3(1, 0, 0)
                       : size.y <= size.z                   ? Vec3(0, 1, 0)
                                                            : Vec3(0, 0, 1);
    across_[0] = glm::normalize(other - glm::dot(other, direction) * direction);
    across_[1] = glm::normalize(glm::cross(direction, across_[0]));
  }

  BruteForce run() {
    for (std::uint32_t patch = 0; patch < surface_.patchCount(); ++patch)
      add({patch, surface_.patchDomain(patch)});
    for (int level = 0; level < kLevels && !cells_.empty() && 4 * cells_.size() <= kMaxCells; ++level) {
      const std::vector<Cell> whole = std::move(cells_);
      cells_.clear();
      for (const Cell& cell : whole) {
        const Interval &u = cell.domain.u, &v = cell.domain.v;
        for (const Interval& partU : {Interval(u.lo, u.mid()), Interval(u.mid(), u.hi)})
          for (const Interval& partV : {Interval(v.lo, v.mid()), Interval(v.mid(), v.hi)})
            add({cell.patch, {partU, partV}});
      }
      std::ranges::sort(cells_, {}, &Cell::nearest);
      for (std::size_t i = 0; i < cells_.size() && i < kProofsPerLevel; ++i) prove(cells_[i]);
    }
    double clear = std::numeric_limits<double>::infinity();
    for (const Cell& cell : cells_) clear = std::min(clear, cell.nearest);
    return {.clearUntil = clear, .metBefore = met_};
  }

 private:
  struct Cell {
    std::uint32_t patch = 0;
    Domain domain;
    double nearest = 0;  // along the ray
  };

  /// How far the ray's line is from what a rectangle holds, in two directions, and how far along it that is.
  struct Offsets {
    std::array<Interval, 2> across;
    Interval along;
    double rounding = 0;
  };

  [[nodiscard]] Offsets offsets(std::uint32_t patch, const Interval& u, const Interval& v) const {
    const PatchInputs inputs(surface_.patches()[patch], parameters_);
    Intervals object, world;
    surface_.patches()[patch].function->position.bound(u, v, inputs, object);
    double size = 0;
    for (int i = 0; i < 3; ++i) {
      Interval sum = Interval(transform_.translation[i]) - Interval(origin_[i]);
      for (int j = 0; j < 3; ++j)
        if (transform_.linear[j][i] != 0)
          sum = sum + Interval(transform_.linear[j][i]) * object[static_cast<std::size_t>(j)];
      world[static_cast<std::size_t>(i)] = sum;
      size += std::abs(transform_.translation[i]) + std::abs(origin_[i]) + sum.magnitude();
    }
    const auto dot = [&](const Vec3& a) {
      return Interval(a.x) * world[0] + Interval(a.y) * world[1] + Interval(a.z) * world[2];
    };
    return {{dot(across_[0]), dot(across_[1])}, dot(direction_), kRounding * size};
  }

  void add(Cell cell) {
    const Offsets o = offsets(cell.patch, cell.domain.u, cell.domain.v);
    const auto passes = [&](const Interval& x) { return x.lo > o.rounding || x.hi < -o.rounding; };
    if (passes(o.across[0]) || passes(o.across[1]) || o.along.hi < nearest_ - o.rounding ||
        o.along.lo > std::min(farthest_, met_.value_or(farthest_)) + o.rounding)
      return;
    cell.nearest = o.along.lo;
    cells_.push_back(cell);
  }

  /// Tries to show that a rectangle around the cell holds a point of the ray.
  void prove(const Cell& cell) {
    const Domain& whole = surface_.patchDomain(cell.patch);
    const auto around = [](const Interval& x, const Interval& all) {
      const double more = kAround * x.width();
      return Interval(std::max(x.lo - more, all.lo), std::min(x.hi + more, all.hi));
    };
    const Interval u = around(cell.domain.u, whole.u), v = around(cell.domain.v, whole.v);
    const Offsets all = offsets(cell.patch, u, v);
    if (!(all.along.lo >= nearest_ + all.rounding && all.along.hi <= farthest_ - all.rounding)) return;
    if (met_ && all.along.hi >= *met_) return;
    // The offsets turned so that the first grows with u alone and the second with v alone, about.
    const auto middle = [&](double x, double y, int k) {
      return offsets(cell.patch, x, y).across[static_cast<std::size_t>(k)].mid();
    };
    std::array<double, 2> du{}, dv{};
    for (const int k : {0, 1}) {
      du[static_cast<std::size_t>(k)] = middle(u.hi, v.mid(), k) - middle(u.lo, v.mid(), k);
      dv[static_cast<std::size_t>(k)] = middle(u.mid(), v.hi, k) - middle(u.mid(), v.lo, k);
    }
    if (!std::isfinite(du[0] + du[1] + dv[0] + dv[1])) return;
    const std::array<double, 2> first{dv[1], -dv[0]}, second{-du[1], du[0]};
    if (opposite(cell.patch, first, u.lo, v, u.hi, v) && opposite(cell.patch, second, u, v.lo, u, v.hi))
      met_ = all.along.hi;
  }

  /// The sign of a combination of both offsets over a rectangle, or an edge; 0: it is not one, or not known.
  [[nodiscard]] int signOn(std::uint32_t patch, const std::array<double, 2>& weights, const Interval& u,
                           const Interval& v, int halvings) const {
    const Offsets o = offsets(patch, u, v);
    const Interval x = Interval(weights[0]) * o.across[0] + Interval(weights[1]) * o.across[1];
    const double rounding = o.rounding * (std::abs(weights[0]) + std::abs(weights[1]));
    if (x.lo > rounding) return 1;
    if (x.hi < -rounding) return -1;
    if (halvings == 0) return 0;
    const bool alongU = u.lo < u.hi;
    const auto half = [&](bool upper) {
      const Interval& all = alongU ? u : v;
      const Interval part = upper ? Interval(all.mid(), all.hi) : Interval(all.lo, all.mid());
      return signOn(patch, weights, alongU ? part : u, alongU ? v : part, halvings - 1);
    };
    const int sign = half(false);
    return sign != 0 && half(true) == sign ? sign : 0;
  }

  /// Whether the combination has opposite signs on two opposite edges: first at their ends, which costs less.
  [[nodiscard]] bool opposite(std::uint32_t patch, const std::array<double, 2>& weights, const Interval& u1,
                              const Interval& v1, const Interval& u2, const Interval& v2) const {
    const auto at = [&](double u, double v) { return signOn(patch, weights, u, v, 0); };
    const int sign = at(u1.lo, v1.lo);
    return sign != 0 && at(u1.hi, v1.hi) == sign && at(u2.lo, v2.lo) == -sign && at(u2.hi, v2.hi) == -sign &&
           signOn(patch, weights, u1, v1, kHalvings) == sign &&
           signOn(patch, weights, u2, v2, kHalvings) == -sign;
  }

  const Surface& surface_;
  std::span<const double> parameters_;
  Transform transform_;
  Vec3 origin_, direction_;
  double nearest_, farthest_;
  std::array<Vec3, 2> across_;
  std::vector<Cell> cells_;
  std::optional<double> met_;
};

}  // namespace

BruteForce bruteForce(const Surface& surface, std::span<const double> parameters,
                      const Transform& worldFromObject, const Vec3& origin, const Vec3& direction,
                      double nearest, double farthest) {
  return Prover(surface, parameters, worldFromObject, origin, direction, nearest, farthest).run();
}

}  // namespace luxo::test
