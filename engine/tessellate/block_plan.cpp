// SPDX-License-Identifier: Apache-2.0
#include "tessellate/block_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>
#include <tuple>

#include "base/assert.h"
#include "surface/bounds.h"
#include "tessellate/parallel.h"

namespace luxo {
namespace {

/// What a border between blocks costs beside the triangles that its vertices add.
constexpr double kBorderPrice = 2;
/// A split has to save this part of the triangles.
constexpr double kLeastSaving = 0.04;

/// Where no bound of the second derivatives exists, tiles become as small as the tolerance: as many and as
/// small as this; fewer on a surface that moves, which is planned for every frame.
constexpr std::size_t kMaxUnprovenTiles = 4096, kMaxUnprovenTilesMoving = 512;
constexpr std::uint32_t kDeepestUnproven = 16;
/// Beside a singularity surfaces bend without limit: there cells stay this much larger than elsewhere.
constexpr double kRoughening = 4;
/// Tiles on which the surface may have no finite size are cut down to this level and drawn with this many
/// segments.
constexpr std::uint32_t kDeepestUnbounded = 6;
constexpr std::uint32_t kUnboundedSegments = 4;

/// Cells narrower than this many tolerances are slivers: of half a pixel, three pixels. The raster's grid
/// turns them over, and every one of them costs as much as a large one.
constexpr double kStoutness = 6;
constexpr double kFew = 4;  // along a patch: never too many

/// `longestEdge` asks for no more segments than this along a patch.
constexpr double kMaxSpacingSegments = 128;

/// The next integer, where a number a rounding error above an integer counts as that.
double roundUp(double segments) { return std::ceil(segments * (1 - 1e-12)); }

struct Range {
  double least = 1, most = kMaxSegments;
};

/// Cells of one tile: how many there may be, and how many rows (columns) of them lose half their triangles at
/// a collapsed edge.
struct Limits {
  Range u, v;
  Vec2 stout{kInfinity};  ///< more segments than this make slivers
  int collapsedRows = 0, collapsedColumns = 0;

  [[nodiscard]] double triangles(double nu, double nv) const {
    return 2 * nu * nv - collapsedRows * nu - collapsedColumns * nv;
  }
  /// Triangles, slivers counting for more than one.
  [[nodiscard]] double price(double nu, double nv) const {
    return triangles(nu, nv) * std::max(1.0, nu / stout.x) * std::max(1.0, nv / stout.y);
  }
};

/// Fewest nv for a given nu, as a real number; infinite when nu alone already misses the tolerance.
double segmentsAcross(const Curvature& c, double nu, double tolerance) {
  if (c.uv == 0 && c.vv == 0) return 1;
  const double room = 8 * tolerance - c.uu / (nu * nu);
  if (!(room > 0)) return kInfinity;
  const double half = c.uv / nu / room;
  return half + std::sqrt(half * half + c.vv / room);
}

/// The segments with the fewest triangles, within 2 % where there are many, whose deviation is within the
/// tolerance; rather more of them than slivers. Every nu that could lead there is tried, or one in 64: from
/// the first that leaves room for v to where not even the nv of infinitely many columns would help.
Segments fewestSegments(const Curvature& c, const Limits& limits, double tolerance) {
  const double fewestAcross = std::max(limits.v.least, roundUp(segmentsAcross({0, 0, c.vv}, 1, tolerance)));
  double best = kInfinity;
  // What cannot be met is met as far as possible.
  Vec2 found(c.uu + c.uv > 0 ? limits.u.most : limits.u.least,
             c.vv + c.uv > 0 ? limits.v.most : limits.v.least);
  double nu = std::max(limits.u.least, roundUp(std::sqrt(c.uu / (8 * tolerance))));
  for (; nu <= limits.u.most && limits.triangles(nu, fewestAcross) < best;
       nu += std::max(1.0, std::floor(nu / 64))) {
    double nv = std::max(limits.v.least, roundUp(segmentsAcross(c, nu, tolerance)));
    if (c.deviation(1 / nu, 1 / nv) > tolerance) ++nv;
    if (nv > limits.v.most || c.deviation(1 / nu, 1 / nv) > tolerance) continue;
    if (limits.price(nu, nv) >= best) continue;
    best = limits.price(nu, nv);
    found = {nu, nv};
  }
  return {static_cast<std::uint32_t>(found.x), static_cast<std::uint32_t>(found.y)};
}

/// The curvature measured in parts of a tile's sides.
Curvature inPartsOf(const Tile& tile, const Curvature& c) {
  const double du = tile.widthU(), dv = tile.widthV();
  return {c.uu * du * du, c.uv * du * dv, c.vv * dv * dv};
}

/// What holds for all tiles of one patch.
class PatchLimits {
 public:
  /// `lengths` of the patch in both directions.
  PatchLimits(const Surface& surface, std::uint32_t patch, Vec2 spacing, Vec2 lengths, double tolerance)
      : stout_(glm::max(lengths / (kStoutness * tolerance), Vec2(kFew))), least_(glm::max(spacing, [&] {
          const Segments least = leastSegments(surface.topology(), patch);
          return Vec2(least.u, least.v);
        }())) {
    for (const Side side : kSides)
      collapsed_[static_cast<std::size_t>(side)] = surface.topology().edge(patch, side).collapsed();
  }

  [[nodiscard]] Limits of(const Tile& tile) const {
    const auto collapsed = [&](Side side) { return collapsed_[static_cast<std::size_t>(side)]; };
    const auto range = [](double least, double width) {
      return Range{std::max(1.0, roundUp(least * width)), std::max(1.0, kMaxSegments * width)};
    };
    return {.u = range(least_.x, tile.widthU()),
            .v = range(least_.y, tile.widthV()),
            .stout = stout_ * Vec2(tile.widthU(), tile.widthV()),
            .collapsedRows =
                (collapsed(Side::VMin) && tile.lowV() == 0) + (collapsed(Side::VMax) && tile.highV() == 1),
            .collapsedColumns =
                (collapsed(Side::UMin) && tile.lowU() == 0) + (collapsed(Side::UMax) && tile.highU() == 1)};
  }

 private:
  Vec2 stout_, least_;
  std::array<bool, 4> collapsed_{};
};

/// Best kd-splits of one patch, by dynamic programming over its tiles.
class PatchPlanner {
 public:
  PatchPlanner(const CurvatureMap& map, std::uint32_t patch, const PatchLimits& limits, double tolerance)
      : map_(map), patch_(patch), limits_(limits), tolerance_(tolerance), plans_(map.tileCount()) {}

  /// Tiles without a bound are appended to `unproven`, all others as blocks.
  void plan(std::vector<Block>& blocks, std::vector<Tile>& unproven) {
    best({});
    collect({}, blocks, unproven);
  }

 private:
  enum class Cut : std::uint8_t { Unknown, None, AcrossU, AcrossV };

  struct Plan {
    Cut cut = Cut::Unknown;
    Segments whole;        ///< if it stays one block
    double triangles = 0;  ///< of the best way
    double least = 0;      ///< that no way can be below
  };

  Plan& best(const Tile& tile) {
    Plan& plan = plans_[map_.numberOf(tile)];
    if (plan.cut != Cut::Unknown) return plan;
    const Curvature& over = map_.over(patch_, tile);
    const bool proven = over.proven();
    const Limits limits = limits_.of(tile);
    plan.cut = Cut::None;
    plan.triangles = kInfinity;
    if (proven) {
      plan.whole = fewestSegments(inPartsOf(tile, over), limits, tolerance_);
      plan.triangles = limits.triangles(plan.whole.u, plan.whole.v);
    }
    const bool acrossU = tile.levelU < map_.levelU(), acrossV = tile.levelV < map_.levelV();
    if (!acrossU && !acrossV) {
      if (!proven) plan.triangles = 2;  // it is what it is: let the others be as good as they can
      return plan;
    }
    if (proven && !worthSplitting(tile, plan, limits)) return plan;
    if (acrossU) tryCut(tile, Cut::AcrossU, plan);
    if (acrossV) tryCut(tile, Cut::AcrossV, plan);
    return plan;
  }

  /// Not if even infinitely fine splits could hardly save anything. Sampled at the finest tiles, which is a
  /// guess where they were not looked at closely.
  bool worthSplitting(const Tile& tile, const Plan& plan, const Limits& limits) const {
    const double fewest = limits.triangles(limits.u.least, limits.v.least);
    return plan.triangles > fewest + kBorderPrice &&
           plan.triangles * (1 - kLeastSaving) - kBorderPrice > localNeed(tile);
  }

  double localNeed(const Tile& tile) const {
    // Two levels down are enough to see whether the bound varies.
    double sum = 0;
    const std::uint32_t u = std::min(tile.levelU + 2, map_.levelU()),
                        v = std::min(tile.levelV + 2, map_.levelV());
    const std::uint32_t columns = 1u << (u - tile.levelU), rows = 1u << (v - tile.levelV);
    for (std::uint32_t i = 0; i < columns; ++i)
      for (std::uint32_t j = 0; j < rows; ++j) {
        const Tile part{u, v, tile.column * columns + i, tile.row * rows + j};
        sum += map_.over(patch_, part).density() * part.widthU() * part.widthV();
      }
    return 0.85 * sum / (2 * tolerance_);
  }

  void tryCut(const Tile& tile, Cut cut, Plan& plan) {
    const auto halves = tile.halves(cut == Cut::AcrossU);
    const Plan &a = best(halves[0]), &b = best(halves[1]);
    // Every vertex that only one side has adds a triangle to the other.
    const auto along = [&](const Plan& p) {
      return static_cast<double>(cut == Cut::AcrossU ? p.whole.v : p.whole.u);
    };
    const double triangles = a.triangles + b.triangles + std::abs(along(a) - along(b)) + kBorderPrice;
    if (!(triangles < plan.triangles * (1 - kLeastSaving))) return;
    plan.cut = cut;
    plan.triangles = triangles;
  }

  void collect(const Tile& tile, std::vector<Block>& blocks, std::vector<Tile>& unproven) const {
    const Plan& plan = plans_[map_.numberOf(tile)];
    if (plan.cut == Cut::None) {
      const Curvature& over = map_.over(patch_, tile);
      if (!over.proven()) {
        unproven.push_back(tile);
        return;
      }
      const Curvature c = inPartsOf(tile, over);
      blocks.push_back({patch_, tile, plan.whole, c.deviation(1.0 / plan.whole.u, 1.0 / plan.whole.v)});
      return;
    }
    for (const Tile& half : tile.halves(plan.cut == Cut::AcrossU)) collect(half, blocks, unproven);
  }

  const CurvatureMap& map_;
  std::uint32_t patch_;
  const PatchLimits& limits_;
  double tolerance_;
  std::vector<Plan> plans_;
};

/// Longest parameter curves of a patch in either direction, object units, by sampling: a size, not a proof.
Vec2 curveLengths(const Surface& surface, std::uint32_t patch, std::span<const double> parameters) {
  constexpr int kSamples = 9;
  const Domain& domain = surface.patchDomain(patch);
  std::vector<double> u(kSamples), v(kSamples);
  for (int i = 0; i < kSamples; ++i) {
    u[i] = domain.u.lo + domain.u.width() * (i + 0.5) / kSamples;
    v[i] = domain.v.lo + domain.v.width() * (i + 0.5) / kSamples;
  }
  const SurfacePoints points = surface.evaluateGrid(patch, u, v, parameters);
  Vec2 longest(0);
  for (std::size_t k = 0; k < points.du.size(); ++k) {
    const Vec2 length(glm::length(points.du[k]) * domain.u.width(),
                      glm::length(points.dv[k]) * domain.v.width());
    if (std::isfinite(length.x + length.y)) longest = glm::max(longest, length);
  }
  return longest;
}

/// Splits tiles without a bound until the box around each is smaller than the tolerance, the largest first.
class UnprovenPlanner {
 public:
  UnprovenPlanner(const Surface& surface, std::span<const double> parameters, double tolerance,
                  double openSize)
      : surface_(surface), parameters_(parameters), tolerance_(tolerance), openSize_(openSize) {}

  void add(std::uint32_t patch, const Tile& tile, const PatchLimits& limits) {
    file(look(patch, tile, limits));
  }

  void plan(std::vector<Block>& blocks) && {
    const std::size_t most = surface_.parameters().empty() ? kMaxUnprovenTiles : kMaxUnprovenTilesMoving;
    while (!open_.empty() && open_.size() + done_.size() < most) {
      const Part part = open_.top();
      open_.pop();
      split(part);
    }
    for (; !open_.empty(); open_.pop()) done_.push_back(blockOf(open_.top()));
    blocks.insert(blocks.end(), proven_.begin(), proven_.end());
    blocks.insert(blocks.end(), done_.begin(), done_.end());
  }

 private:
  struct Part {
    std::uint32_t patch = 0;
    Tile tile;
    const PatchLimits* limits = nullptr;
    Curvature curvature;  ///< in parts of the tile's sides
    double diameter = 0;  ///< of the box around it, 0 where the curvature is proven
    bool open = false;

    bool operator<(const Part& other) const {
      const auto key = [](const Part& p) {
        return std::tuple(p.diameter, p.patch, p.tile.levelU, p.tile.levelV, p.tile.column, p.tile.row);
      };
      return key(*this) < key(other);
    }
  };

  [[nodiscard]] Part look(std::uint32_t patch, const Tile& tile, const PatchLimits& limits) const {
    const Domain& domain = surface_.patchDomain(patch);
    const Domain cell = domainOf(tile, domain);
    Part part{patch, tile, &limits, inPartsOf(tile, curvatureOf(surface_, patch, domain, cell, parameters_))};
    if (part.curvature.proven()) return part;
    const Box box = surface_.boundPosition(patch, cell, parameters_);
    if (box.empty()) return part;  // nothing is there
    part.diameter = glm::length(box.extent());
    if (!std::isfinite(part.diameter)) part.diameter = kInfinity;
    const Patch& p = surface_.patches()[patch];
    part.open = openSize_ > 0 && !definedAllOver(*p.function, cell, PatchInputs(p, parameters_));
    return part;
  }

  /// Across the direction that leaves the smaller boxes.
  void split(const Part& part) {
    std::array<std::array<Part, 2>, 2> ways;
    std::array<double, 2> largest{};
    for (const bool acrossU : {true, false})
      for (std::size_t i = 0; i < 2; ++i) {
        ways[acrossU][i] = look(part.patch, part.tile.halves(acrossU)[i], *part.limits);
        largest[acrossU] = std::max(largest[acrossU], ways[acrossU][i].diameter);
      }
    const bool acrossU =
        largest[0] != largest[1] ? largest[1] < largest[0] : part.tile.levelU <= part.tile.levelV;
    for (const Part& half : ways[acrossU]) file(half);
  }

  void file(const Part& part) {
    if (part.curvature.proven()) {
      Limits limits = part.limits->of(part.tile);
      for (Range* range : {&limits.u, &limits.v})
        range->most = std::max(range->least, std::floor(range->most / kRoughening));
      const Segments n = fewestSegments(part.curvature, limits, tolerance_);
      proven_.push_back({part.patch, part.tile, n, part.curvature.deviation(1.0 / n.u, 1.0 / n.v)});
    } else if (part.diameter > (part.open ? std::max(openSize_, tolerance_) : tolerance_) &&
               splittable(part)) {
      open_.push(part);
    } else {
      done_.push_back(blockOf(part));
    }
  }

  [[nodiscard]] bool splittable(const Part& part) const {
    const std::uint32_t level = std::max(part.tile.levelU, part.tile.levelV);
    if (std::isfinite(part.diameter)) return level < kDeepestUnproven;
    return level < kDeepestUnbounded && hasPoints(part.patch, part.tile);
  }

  static Block blockOf(const Part& part) {
    const Limits limits = part.limits->of(part.tile);
    Segments n{static_cast<std::uint32_t>(limits.u.least), static_cast<std::uint32_t>(limits.v.least)};
    if (std::isinf(part.diameter)) n = {std::max(n.u, kUnboundedSegments), std::max(n.v, kUnboundedSegments)};
    return {part.patch, part.tile, n, part.open ? 0 : part.diameter, part.open, true};
  }

  /// Whether the formula has a value at any of a few points of the tile.
  [[nodiscard]] bool hasPoints(std::uint32_t patch, const Tile& tile) const {
    const Domain cell = domainOf(tile, surface_.patchDomain(patch));
    const std::array<double, 3> u{cell.u.lo, cell.u.mid(), cell.u.hi}, v{cell.v.lo, cell.v.mid(), cell.v.hi};
    const std::vector<Vec3> points = surface_.evaluateGrid(patch, u, v, parameters_).position;
    return std::any_of(points.begin(), points.end(),
                       [](const Vec3& p) { return std::isfinite(p.x + p.y + p.z); });
  }

  const Surface& surface_;
  std::span<const double> parameters_;
  double tolerance_, openSize_;
  std::priority_queue<Part> open_;
  std::vector<Block> proven_, done_;
};

/// The tolerance that a budget of triangles allows.
double affordableTolerance(const Surface& surface, const CurvatureMap& map, double tolerance) {
  double need = 0;
  for (std::uint32_t patch = 0; patch < surface.patchCount(); ++patch)
    for (std::uint32_t column = 0; column < 1u << map.levelU(); ++column)
      for (std::uint32_t row = 0; row < 1u << map.levelV(); ++row) {
        const Tile tile{map.levelU(), map.levelV(), column, row};
        const Curvature& c = map.over(patch, tile);
        if (c.proven()) need += c.density() * tile.widthU() * tile.widthV();
      }
  // Below the tolerance by what rounding adds to a mesh's bound.
  return std::max(tolerance * (1 - 1e-6), need / (2 * kMaxTriangles));
}

}  // namespace

Segments leastSegments(const Topology& topology, std::uint32_t patch) {
  const auto least = [&](Side lower, Side upper) {
    const PatchEdge low{patch, lower}, high{patch, upper};
    std::vector<std::uint32_t> beyondLow, beyondHigh;
    for (const Joint& joint : topology.joints) {
      if ((joint.a == low && joint.b == high) || (joint.a == high && joint.b == low)) return 3u;
      for (const auto& [here, there] : {std::pair(joint.a, joint.b), std::pair(joint.b, joint.a)}) {
        if (here == low) beyondLow.push_back(there.patch);
        if (here == high) beyondHigh.push_back(there.patch);
      }
    }
    for (const std::uint32_t neighbour : beyondLow)
      if (std::find(beyondHigh.begin(), beyondHigh.end(), neighbour) != beyondHigh.end()) return 2u;
    const bool poles = topology.edge(patch, lower).collapsed() && topology.edge(patch, upper).collapsed();
    return poles ? 2u : 1u;
  };
  return {least(Side::UMin, Side::UMax), least(Side::VMin, Side::VMax)};
}

std::vector<Block> planBlocks(const Surface& surface, std::span<const double> parameters,
                              const CurvatureMap& map, const MeshDesc& desc, double openSize) {
  const double tolerance = affordableTolerance(surface, map, desc.tolerance);
  std::vector<PatchLimits> limits;
  for (std::uint32_t patch = 0; patch < surface.patchCount(); ++patch) {
    const Vec2 lengths = curveLengths(surface, patch, parameters);
    const Vec2 spacing = glm::clamp(lengths / desc.longestEdge, Vec2(1), Vec2(kMaxSpacingSegments));
    limits.emplace_back(surface, patch, spacing, lengths, tolerance);
  }

  struct Plan {
    std::vector<Block> blocks;
    std::vector<Tile> unproven;
  };
  std::vector<Plan> plans(surface.patchCount());
  forEachIndex(plans.size(), plans.size() >= kPatchesForAllCores, [&](std::size_t p) {
    const auto patch = static_cast<std::uint32_t>(p);
    PatchPlanner(map, patch, limits[p], tolerance).plan(plans[p].blocks, plans[p].unproven);
  });

  std::vector<Block> blocks;
  UnprovenPlanner rest(surface, parameters, tolerance, openSize);
  for (std::uint32_t patch = 0; patch < surface.patchCount(); ++patch) {
    blocks.insert(blocks.end(), plans[patch].blocks.begin(), plans[patch].blocks.end());
    for (const Tile& tile : plans[patch].unproven) rest.add(patch, tile, limits[patch]);
  }
  std::move(rest).plan(blocks);
  return blocks;
}

std::vector<Block> uniformBlocks(const Surface& surface, std::span<const double> parameters,
                                 Segments segments) {
  const PartialBounds m = surface.partialBounds(parameters);
  const bool mixedCounts = !surface.flatNormal() && !surface.revolution();
  std::vector<Block> blocks;
  for (std::uint32_t patch = 0; patch < surface.patchCount(); ++patch) {
    const Segments least = leastSegments(surface.topology(), patch);
    const Segments n{std::clamp(segments.u, least.u, kMaxSegments),
                     std::clamp(segments.v, least.v, kMaxSegments)};
    const Domain& domain = surface.patchDomain(patch);
    const double du = domain.u.width(), dv = domain.v.width();
    const Curvature c{m.uu * du * du, mixedCounts ? m.uv * du * dv : 0, m.vv * dv * dv};
    blocks.push_back({patch, {}, n, c.deviation(1.0 / n.u, 1.0 / n.v)});
  }
  return blocks;
}

}  // namespace luxo
