// SPDX-License-Identifier: Apache-2.0
#include "tessellate/curvature_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "tessellate/parallel.h"

namespace luxo {
namespace {

constexpr std::uint32_t kMaxLevels = 5;      // of the map
constexpr std::uint32_t kDeepestLevel = 10;  // of what is looked at to make it
/// Half a turn is bounded no better than a whole one, nor is a quarter: that says nothing about the eighth.
constexpr std::uint32_t kBlindLevels = 3;
/// A surface that moves has a map for every frame.
constexpr std::size_t kMaxLeaves = 2048, kMaxLeavesMoving = 256, kFewestLeaves = 16;
constexpr double kWild = 1e6;         // times what the others have
constexpr double kGoodEnough = 0.04;  // more triangles than sharper bounds would give

Curvature inParts(const Surface& surface, const Domain& domain, const PartialBounds& m) {
  const bool mixedCounts = !surface.flatNormal() && !surface.revolution();
  const double du = domain.u.width(), dv = domain.v.width();
  const double mixed = m.uv * du * dv;
  return {m.uu * du * du, mixedCounts ? mixed : 0, m.vv * dv * dv, mixed};
}

/// A tile whose bound is known, with what looking closer may bring.
struct Leaf {
  Tile tile;
  Curvature bound;
  double excess = 0;            ///< triangles above what its middle alone would need
  double gainU = 0, gainV = 0;  ///< expected of splitting across u, across v

  bool operator<(const Leaf& other) const { return excess < other.excess; }
};

/// Splits where that lowers the number of triangles most.
class PatchExplorer {
 public:
  PatchExplorer(const Surface& surface, std::uint32_t patch, std::span<const double> parameters,
                std::uint32_t mapLevelU, std::uint32_t mapLevelV, std::size_t mostLeaves)
      : surface_(surface),
        patch_(patch),
        parameters_(parameters),
        inputs_(surface.patches()[patch].constants),
        mapLevelU_(mapLevelU),
        mapLevelV_(mapLevelV),
        mostLeaves_(mostLeaves) {
    inputs_.insert(inputs_.end(), parameters.begin(), parameters.end());
  }

  std::vector<Leaf> explore() && {
    push(look({}));
    while (!open_.empty() && open_.size() + done_.size() < mostLeaves_) {
      if (unproven_ == 0 && excess_ <= kGoodEnough * needed_) break;
      const Leaf leaf = pop();
      split(leaf);
    }
    done_.insert(done_.end(), open_.begin(), open_.end());
    return std::move(done_);
  }

 private:
  /// A price for every bound, as those in one direction only take few triangles, but not none.
  static double price(const Curvature& c) { return c.density() + 1e-3 * (c.uu + c.vv); }

  Leaf look(const Tile& tile) const {
    const Domain& domain = surface_.patchDomain(patch_);
    // Turning about the axis changes no length: one meridian has them all.
    Domain cell = domainOf(tile, domain);
    if (surface_.revolution()) cell.u = Interval(cell.u.lo);
    Leaf leaf{.tile = tile, .bound = curvatureOf(surface_, patch_, domain, cell, parameters_)};
    if (!leaf.bound.proven()) {
      leaf.excess = kInfinity;
      return leaf;
    }
    const Curvature middle = curvatureOf(surface_, patch_, domain, {cell.u.mid(), cell.v.mid()}, parameters_);
    const double area = tile.widthU() * tile.widthV();
    leaf.excess = area * (price(leaf.bound) - (middle.proven() ? price(middle) : 0));
    return leaf;
  }

  /// What is really taken at a point; rounded, as it decides nothing but where to look.
  [[nodiscard]] Curvature at(double u, double v) const {
    std::array<double, 9> second{};
    surface_.patches()[patch_].function->second.evaluatePoint(u, v, inputs_, second);
    const auto length = [&](std::size_t k) {
      return glm::length(Vec3(second[k], second[k + 1], second[k + 2]));
    };
    return inParts(surface_, surface_.patchDomain(patch_), {length(0), length(3), length(6)});
  }

  [[nodiscard]] double cost(const Leaf& leaf) const {
    return leaf.tile.widthU() * leaf.tile.widthV() * price(leaf.bound);
  }

  [[nodiscard]] bool splittable(const Tile& tile, bool acrossU, bool proven) const {
    if (acrossU && surface_.revolution()) return false;
    const std::uint32_t level = acrossU ? tile.levelU : tile.levelV;
    return level < (proven ? kDeepestLevel : acrossU ? mapLevelU_ : mapLevelV_);
  }

  void push(const Leaf& leaf) {
    const bool proven = leaf.bound.proven();
    if (proven) {
      needed_ += cost(leaf) - leaf.excess;
      excess_ += leaf.excess;
    }
    if (!splittable(leaf.tile, true, proven) && !splittable(leaf.tile, false, proven)) {
      done_.push_back(leaf);
      return;
    }
    if (!proven) ++unproven_;
    open_.push_back(leaf);
    std::push_heap(open_.begin(), open_.end());
  }

  Leaf pop() {
    std::pop_heap(open_.begin(), open_.end());
    Leaf leaf = open_.back();
    open_.pop_back();
    if (leaf.bound.proven()) {
      needed_ -= cost(leaf) - leaf.excess;
      excess_ -= leaf.excess;
      // What is left of the sums is rounding of what has gone: wild bounds come first.
      if (leaf.excess > kWild * excess_) addUp();
    } else {
      --unproven_;
    }
    return leaf;
  }

  void addUp() {
    needed_ = excess_ = 0;
    for (const std::vector<Leaf>* leaves : {&open_, &done_})
      for (const Leaf& leaf : *leaves) {
        if (!leaf.bound.proven()) continue;
        needed_ += cost(leaf) - leaf.excess;
        excess_ += leaf.excess;
      }
  }

  void split(const Leaf& leaf) {
    const bool proven = leaf.bound.proven();
    const double gainU = leaf.tile.levelU < kBlindLevels ? kInfinity : leaf.gainU;
    const double gainV = leaf.tile.levelV < kBlindLevels ? kInfinity : leaf.gainV;
    bool acrossU = gainU != gainV ? gainU > gainV : leaf.tile.levelU <= leaf.tile.levelV;
    if (!splittable(leaf.tile, acrossU, proven)) acrossU = !acrossU;
    std::array<Leaf, 2> halves;
    for (std::size_t i = 0; i < 2; ++i) halves[i] = look(leaf.tile.halves(acrossU)[i]);
    // What intervals overestimate, and what the bound varies, shrinks with the width: the next split in this
    // direction gains half as much, shared by two.
    double gained = kInfinity;
    if (proven) gained = std::max(0.0, cost(leaf) - cost(halves[0]) - cost(halves[1]));
    for (Leaf& half : halves) {
      half.gainU = acrossU ? gained / 4 : leaf.gainU / 2;
      half.gainV = acrossU ? leaf.gainV / 2 : gained / 4;
      push(half);
    }
  }

  const Surface& surface_;
  std::uint32_t patch_;
  std::span<const double> parameters_;
  std::vector<double> inputs_;  ///< of the patch's function
  std::uint32_t mapLevelU_, mapLevelV_;
  std::size_t mostLeaves_;
  std::vector<Leaf> open_;  ///< a heap: the largest excess first
  std::vector<Leaf> done_;
  std::size_t unproven_ = 0;
  double needed_ = 0, excess_ = 0;
};

/// First and one past the last of the 2^mapLevel parts that the `index`th of 2^level parts touches.
std::pair<std::uint32_t, std::uint32_t> covered(std::uint32_t index, std::uint32_t level,
                                                std::uint32_t mapLevel) {
  if (level <= mapLevel) return {index << (mapLevel - level), (index + 1) << (mapLevel - level)};
  return {index >> (level - mapLevel), (index >> (level - mapLevel)) + 1};
}

}  // namespace

Curvature larger(const Curvature& a, const Curvature& b) {
  return {std::max(a.uu, b.uu), std::max(a.uv, b.uv), std::max(a.vv, b.vv), std::max(a.mixed, b.mixed)};
}

bool Curvature::proven() const { return std::isfinite(uu + uv + vv); }

double Curvature::density() const { return std::sqrt(uu * vv) + uv; }

Curvature curvatureOf(const Surface& surface, std::uint32_t patch, const Domain& domain, const Domain& cell,
                      std::span<const double> parameters) {
  const Surface::CellBounds bounds = surface.boundCell(patch, cell, parameters);
  if (bounds.kinked) return {kInfinity, kInfinity, kInfinity, kInfinity};
  return inParts(surface, domain, bounds.second);
}

CurvatureMap::CurvatureMap(const Surface& surface, std::span<const double> parameters) {
  // Many patches are small ones: the tiles of all of them together stay about as many.
  std::uint32_t levels = kMaxLevels;
  for (std::uint32_t patches = surface.patchCount(); patches > 4 && levels > 1; patches /= 4) --levels;
  levelU_ = surface.revolution() ? 0 : levels;
  levelV_ = levels;
  const std::size_t most = surface.parameters().empty() ? kMaxLeaves : kMaxLeavesMoving;
  const std::size_t mostLeaves = std::max(kFewestLeaves, 2 * most / (1 + surface.patchCount()));
  tiles_.resize(surface.patchCount());
  forEachIndex(surface.patchCount(), surface.patchCount() >= kPatchesForAllCores, [&](std::size_t p) {
    const auto patch = static_cast<std::uint32_t>(p);
    std::vector<Curvature>& tiles = tiles_[p];
    tiles.resize(tileCount());
    for (const Leaf& leaf :
         PatchExplorer(surface, patch, parameters, levelU_, levelV_, mostLeaves).explore()) {
      const auto [firstColumn, columnEnd] = covered(leaf.tile.column, leaf.tile.levelU, levelU_);
      const auto [firstRow, rowEnd] = covered(leaf.tile.row, leaf.tile.levelV, levelV_);
      for (std::uint32_t column = firstColumn; column < columnEnd; ++column)
        for (std::uint32_t row = firstRow; row < rowEnd; ++row) {
          Curvature& tile = tiles[numberOf({levelU_, levelV_, column, row})];
          tile = larger(tile, leaf.bound);
        }
    }
    const auto join = [&](const Tile& tile, bool acrossU) {
      const auto halves = tile.halves(acrossU);
      tiles[numberOf(tile)] = larger(tiles[numberOf(halves[0])], tiles[numberOf(halves[1])]);
    };
    for (std::uint32_t u = levelU_ + 1; u-- > 0;)
      for (std::uint32_t v = levelV_ + 1; v-- > 0;)
        for (std::uint32_t column = 0; column < 1u << u; ++column)
          for (std::uint32_t row = 0; row < 1u << v; ++row)
            if (v < levelV_)
              join({u, v, column, row}, false);
            else if (u < levelU_)
              join({u, v, column, row}, true);
  });
}

}  // namespace luxo
