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
      : function_(*patch.function), domain_(patch.domain), inputs_(inputs), found_(kSide * kSide) {}

  std::vector<Domain> run() {
    if (isFinite(boundPosition(function_, domain_, inputs_))) return {};
    findUndefinedPoints();
    findUnboundedCells();
    std::vector<Domain> holes;
    for (int place = 0; place < kSide * kSide; ++place)
      if (found_[place]) holes.push_back(widen(takeGroup(place)));
    while (holes.size() > kMostHoles) {
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

  /// Follows what cannot be bounded into ever smaller halves. Intervals alone prove no hole: they also give
  /// up where a root or a quotient stays just defined.
  [[nodiscard]] std::optional<Domain> unboundedPart(Domain cell) const {
    if (isFinite(boundPosition(function_, cell, inputs_))) return {};
    for (int k = 0; k < kBisections; ++k) {
      const bool splitU = k % 2 == 0;
      Domain lower = cell, upper = cell;
      (splitU ? lower.u.hi : lower.v.hi) = (splitU ? upper.u.lo : upper.v.lo) =
          splitU ? cell.u.mid() : cell.v.mid();
      const bool lowerFails = !isFinite(boundPosition(function_, lower, inputs_));
      const bool upperFails = !isFinite(boundPosition(function_, upper, inputs_));
      if (!lowerFails && !upperFails) return {};
      // A line through both halves: it is followed where it is, on either of them.
      cell = lowerFails ? lower : upper;
    }
    double farthest = 0;
    for (const double u : {cell.u.lo, cell.u.mid(), cell.u.hi})
      for (const double v : {cell.v.lo, cell.v.mid(), cell.v.hi})
        farthest = std::max(farthest, glm::length(position(u, v) - spread_.center));
    if (farthest <= kUnbounded * spread_.radius) return {};
    return cell;
  }

  /// The hull of what hangs together with a place, which is then forgotten.
  Domain takeGroup(int place) {
    Domain group = *found_[place];
    std::vector<int> open{place};
    found_[place].reset();
    while (!open.empty()) {
      const int x = open.back() % kSide, y = open.back() / kSide;
      open.pop_back();
      for (int j = std::max(0, y - 2); j <= std::min(kSide - 1, y + 2); ++j)
        for (int i = std::max(0, x - 2); i <= std::min(kSide - 1, x + 2); ++i) {
          std::optional<Domain>& neighbour = found_[j * kSide + i];
          if (!neighbour) continue;
          group = hull(group, *neighbour);
          neighbour.reset();
          open.push_back(j * kSide + i);
        }
    }
    return group;
  }

  [[nodiscard]] bool definedAlong(bool alongV, double fixed, const Interval& range) const {
    std::vector<double> along(kLineSamples), across(kLineSamples, fixed);
    for (int k = 0; k < kLineSamples; ++k) along[k] = at(range, k, kLineSamples - 1);
    const auto s = alongV ? function_.position.evaluate(across, along, inputs_)
                          : function_.position.evaluate(along, across, inputs_);
    for (int k = 0; k < kLineSamples; ++k)
      if (!isFinite(Vec3(s[0][k], s[1][k], s[2][k]))) return false;
    return true;
  }

  /// Moves one side from the last undefined sample to where the formula becomes defined, less than a cell on.
  [[nodiscard]] double sideOf(double inside, double outside, bool alongV, const Interval& range) const {
    for (int k = 0; k < kBisections; ++k) {
      const double middle = inside + 0.5 * (outside - inside);
      (definedAlong(alongV, middle, range) ? outside : inside) = middle;
    }
    return inside;
  }

  [[nodiscard]] Domain widen(Domain hole) const {
    const double stepU = domain_.u.width() / kCells, stepV = domain_.v.width() / kCells;
    const Domain within = hole;
    hole.u.lo = sideOf(within.u.lo, std::max(domain_.u.lo, within.u.lo - stepU), true, within.v);
    hole.u.hi = sideOf(within.u.hi, std::min(domain_.u.hi, within.u.hi + stepU), true, within.v);
    hole.v.lo = sideOf(within.v.lo, std::max(domain_.v.lo, within.v.lo - stepV), false, within.u);
    hole.v.hi = sideOf(within.v.hi, std::min(domain_.v.hi, within.v.hi + stepV), false, within.u);
    return hole;
  }

  const SurfaceFunction& function_;
  const Domain& domain_;
  std::span<const double> inputs_;
  std::vector<std::optional<Domain>> found_;  // undefined points and unbounded cells by their place
  Spread spread_;
};

}  // namespace

std::vector<Domain> findHoles(const Patch& patch, std::span<const double> inputs) {
  return HoleSearch(patch, inputs).run();
}

}  // namespace luxo
