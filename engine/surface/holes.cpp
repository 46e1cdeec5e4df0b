// SPDX-License-Identifier: Apache-2.0
#include "surface/holes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "math/vec.h"
#include "surface/bounds.h"
#include "surface/spread.h"

namespace luxo {
namespace {

constexpr int kCells = 64;
constexpr int kLineSamples = 33;
constexpr int kBisections = 30;
constexpr std::size_t kMaxGroupRectangles = 4;
/// A formula that takes values this many times as large as elsewhere, so near to a place where it cannot be
/// bounded, is unbounded there.
constexpr double kUnbounded = 100;

double at(const Interval& range, int k, int count) {
  return k == count ? range.hi : range.lo + range.width() * k / count;
}

Domain hull(const Domain& a, const Domain& b) { return {hull(a.u, b.u), hull(a.v, b.v)}; }

class HoleSearch {
 public:
  HoleSearch(const Patch& patch, std::span<const double> inputs)
      : function_(*patch.function),
        domain_(patch.domain),
        inputs_(inputs),
        found_(kSide * kSide),
        taken_(kSide * kSide) {}

  std::vector<Domain> run() {
    if (definedAllOver(function_, domain_, inputs_)) return {};
    findUndefinedPoints();
    findUnboundedCells();
    std::vector<Domain> holes;
    for (int place = 0; place < kSide * kSide; ++place)
      if (found_[place] && !taken_[place]) appendWidened(rectanglesOf(groupOf(place)), holes);
    while (holes.size() > kMaxHoles) {
      const Domain last = holes.back();
      holes.pop_back();
      holes.back() = hull(holes.back(), last);
    }
    return holes;
  }

 private:
  static constexpr int kSide = 2 * kCells + 1;  // grid points on even places, cells on odd ones

  [[nodiscard]] Vec3 position(double u, double v) const {
    const auto s = function_.position.evaluate({&u, 1}, {&v, 1}, inputs_);
    return {s[0][0], s[1][0], s[2][0]};
  }

  void findUndefinedPoints() {
    std::vector<double> us, vs;
    for (int k = 0; k <= kCells; ++k) {
      us.push_back(at(domain_.u, k, kCells));
      vs.push_back(at(domain_.v, k, kCells));
    }
    const auto s = function_.position.evaluateGrid(us, vs, inputs_);
    std::vector<Vec3> points;
    for (int j = 0; j <= kCells; ++j)
      for (int i = 0; i <= kCells; ++i) {
        const std::size_t k = static_cast<std::size_t>(j) * us.size() + i;
        const Vec3 p(s[0][k], s[1][k], s[2][k]);
        if (isFinite(p))
          points.push_back(p);
        else
          found_[2 * j * kSide + 2 * i] = Domain{us[i], vs[j]};
      }
    if (!points.empty()) spread_ = spreadOf(points);
  }

  void findUnboundedCells() {
    for (int j = 0; j < kCells; ++j)
      for (int i = 0; i < kCells; ++i) {
        const int place = (2 * j + 1) * kSide + 2 * i + 1;
        const bool touched = found_[place - kSide - 1] || found_[place - kSide + 1] ||
                             found_[place + kSide - 1] || found_[place + kSide + 1];
        if (!touched)
          found_[place] = unboundedPart({{at(domain_.u, i, kCells), at(domain_.u, i + 1, kCells)},
                                         {at(domain_.v, j, kCells), at(domain_.v, j + 1, kCells)}});
      }
  }

  /// Where the formula grows without bound inside a cell, from one end of it to the other. Intervals alone
  /// prove no hole: they also give up where a root or a quotient stays just defined.
  [[nodiscard]] std::optional<Domain> unboundedPart(const Domain& cell) const {
    if (definedAllOver(function_, cell, inputs_)) return {};
    const std::optional<Domain> first = followUnbounded(cell, false), last = followUnbounded(cell, true);
    return first && last ? hull(*first, *last) : first ? first : last;
  }

  /// Follows what cannot be bounded into ever smaller halves: of two that fail, always the same.
  [[nodiscard]] std::optional<Domain> followUnbounded(Domain cell, bool preferUpper) const {
    for (int k = 0; k < kBisections; ++k) {
      const bool splitU = k % 2 == 0;
      Domain lower = cell, upper = cell;
      (splitU ? lower.u.hi : lower.v.hi) = (splitU ? upper.u.lo : upper.v.lo) =
          splitU ? cell.u.mid() : cell.v.mid();
      const Domain &first = preferUpper ? upper : lower, &second = preferUpper ? lower : upper;
      if (!definedAllOver(function_, first, inputs_))
        cell = first;
      else if (!definedAllOver(function_, second, inputs_))
        cell = second;
      else
        return {};
    }
    double farthest = 0;
    for (const double u : {cell.u.lo, cell.u.mid(), cell.u.hi})
      for (const double v : {cell.v.lo, cell.v.mid(), cell.v.hi})
        farthest = std::max(farthest, glm::length(position(u, v) - spread_.center));
    if (farthest <= kUnbounded * spread_.radius) return {};
    return cell;
  }

  /// The places that hang together with one.
  [[nodiscard]] std::vector<int> groupOf(int place) {
    std::vector<int> group{place};
    taken_[place] = true;
    for (std::size_t next = 0; next < group.size(); ++next) {
      const int x = group[next] % kSide, y = group[next] / kSide;
      for (int j = std::max(0, y - 2); j <= std::min(kSide - 1, y + 2); ++j)
        for (int i = std::max(0, x - 2); i <= std::min(kSide - 1, x + 2); ++i) {
          const int neighbour = j * kSide + i;
          if (!found_[neighbour] || taken_[neighbour]) continue;
          taken_[neighbour] = true;
          group.push_back(neighbour);
        }
    }
    std::ranges::sort(group);
    return group;
  }

  /// A group as a few rectangles, a row's runs joined to equal ones of the row before: bands, frames,
  /// crossing lines. As one, where that takes too many: a disk.
  [[nodiscard]] std::vector<Domain> rectanglesOf(const std::vector<int>& group) const {
    struct Run {
      int left, right, row;
      Domain domain;
    };
    std::vector<Run> runs;
    Domain all = *found_[group.front()];
    for (std::size_t k = 0; k < group.size();) {
      const int left = group[k] % kSide, row = group[k] / kSide;
      Run run{left, left, row, *found_[group[k]]};
      for (++k; k < group.size() && group[k] / kSide == row && group[k] % kSide <= run.right + 2; ++k) {
        run.right = group[k] % kSide;
        run.domain = hull(run.domain, *found_[group[k]]);
      }
      all = hull(all, run.domain);
      const auto above = std::ranges::find_if(runs, [&](const Run& r) {
        return row - r.row <= 2 && r.row < row && std::abs(r.left - run.left) <= 1 &&
               std::abs(r.right - run.right) <= 1;
      });
      if (above == runs.end())
        runs.push_back(run);
      else
        *above = {above->left, above->right, row, hull(above->domain, run.domain)};
    }
    if (runs.size() > kMaxGroupRectangles) return {all};
    std::vector<Domain> rectangles;
    for (const Run& run : runs) rectangles.push_back(run.domain);
    return rectangles;
  }

  /// Moves the sides of rectangles that hang together from the last undefined sample to where the formula
  /// becomes defined, less than a cell on. What another of them holds is not asked again.
  void appendWidened(const std::vector<Domain>& rectangles, std::vector<Domain>& holes) const {
    const double stepU = domain_.u.width() / kCells, stepV = domain_.v.width() / kCells;
    for (const Domain& own : rectangles) {
      const auto otherHolds = [&](double u, double v) {
        return std::ranges::any_of(rectangles, [&](const Domain& other) {
          return !(other == own) && Interval(other.u.lo - stepU, other.u.hi + stepU).contains(u) &&
                 Interval(other.v.lo - stepV, other.v.hi + stepV).contains(v);
        });
      };
      const auto definedAt = [&](double u, double v) { return otherHolds(u, v) || isFinite(position(u, v)); };
      const auto columnDefined = [&](double u) {
        return everyOf(own.v, [&](double v) { return definedAt(u, v); });
      };
      const auto rowDefined = [&](double v) {
        return everyOf(own.u, [&](double u) { return definedAt(u, v); });
      };
      holes.push_back({{sideOf(own.u.lo, std::max(domain_.u.lo, own.u.lo - stepU), columnDefined),
                        sideOf(own.u.hi, std::min(domain_.u.hi, own.u.hi + stepU), columnDefined)},
                       {sideOf(own.v.lo, std::max(domain_.v.lo, own.v.lo - stepV), rowDefined),
                        sideOf(own.v.hi, std::min(domain_.v.hi, own.v.hi + stepV), rowDefined)}});
    }
  }

  template <class Test>
  static bool everyOf(const Interval& range, const Test& test) {
    for (int k = 0; k < kLineSamples; ++k)
      if (!test(at(range, k, kLineSamples - 1))) return false;
    return true;
  }

  template <class Test>
  static double sideOf(double inside, double outside, const Test& defined) {
    for (int k = 0; k < kBisections; ++k) {
      const double middle = inside + 0.5 * (outside - inside);
      (defined(middle) ? outside : inside) = middle;
    }
    return inside;
  }

  const SurfaceFunction& function_;
  const Domain& domain_;
  std::span<const double> inputs_;
  std::vector<std::optional<Domain>> found_;  // undefined points and unbounded cells by their place
  std::vector<bool> taken_;                   // those that belong to a group
  Spread spread_;
};

}  // namespace

std::vector<Domain> findHoles(const Patch& patch, std::span<const double> inputs) {
  return HoleSearch(patch, inputs).run();
}

}  // namespace luxo
