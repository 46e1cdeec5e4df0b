// SPDX-License-Identifier: Apache-2.0
#include "shell/shell_refinement.h"

#include <algorithm>
#include <cmath>

#include "tessellate/parallel.h"

namespace luxo {
namespace {

/// What deviates by less than this part of the tolerance is fine enough, whatever its shape.
constexpr double kFineEnough = 1.0 / 64;
/// Between the normal of a triangle and those of its surface, radians: beyond, a cell may hold more than one
/// fold, and a search find the second, where the surface leaves the triangle by this part of the tolerance.
constexpr double kMaxBend = 1, kFlatEnough = 1.0 / 16;
/// Moved triangles may shrink by this part of their sides: beyond, they turn over.
constexpr double kMaxShrinking = 1;
/// Blocks are not cut while more of their triangles than this part are too coarse.
constexpr double kMostly = 0.4;
/// Nor are blocks of so few cells where a little more will do.
constexpr std::uint32_t kFewCells = 16;
constexpr double kLittle = 1.5;
constexpr std::uint32_t kDeepest = 14;

/// A triangle that is too coarse.
struct Coarse {
  Vec2 center{0};           ///< in parts of the patch's sides
  double excess = 1;        ///< how many times as many segments it takes
  bool u = true, v = true;  ///< along which directions
};

class Refinement {
 public:
  Refinement(const Surface& surface, std::span<const double> parameters, const ShellDesc& desc,
             const ShellFrame& frame)
      : surface_(surface), parameters_(parameters), desc_(desc), frame_(frame), mesh_(frame.mesh()) {
    moves_.resize(frame.pointCount());
    forEachIndex(moves_.size(), moves_.size() >= kPointsForAllCores, [&](std::size_t p) {
      moves_[p] = shortestMove(frame.facetsAround(p), {}, 1, {1, 1}).way;
    });
  }

  bool refine(std::vector<Block>& blocks) {
    bool changed = false;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      std::vector<Coarse> coarse = coarseTriangles(b, blocks[b]);
      changed = changed || !coarse.empty();
      refine(blocks[b], std::move(coarse));
    }
    blocks = std::move(refined_);
    return changed;
  }

 private:
  [[nodiscard]] std::vector<Coarse> coarseTriangles(std::size_t b, const Block& block) const {
    std::vector<Coarse> coarse;
    for (std::size_t t = frame_.firstTriangle(b); t < frame_.firstTriangle(b + 1); ++t) {
      if (heightOf(t) < kFineEnough * desc_.tolerance || frame_.facet(t) == Vec3(0)) continue;
      const double turn = turnOf(t, block) / desc_.mostTurn;
      const bool bends = heightOf(t) > kFlatEnough * desc_.tolerance;
      const double bend = bends ? angleOf(frame_.heights().alike[t]) / kMaxBend : 0;
      const double shrinking = std::sqrt(shrinkingOf(t) / kMaxShrinking);
      const double excess = std::max({turn, bend, shrinking});
      if (!(excess > 1)) continue;
      Coarse c{.center = centerOf(t, block.patch), .excess = excess};
      if (turn == excess) {
        const Vec2 turns = turnsAlong(t, block);
        c.u = turns.x >= 0.5 * turns.y;
        c.v = turns.y >= 0.5 * turns.x;
      }
      coarse.push_back(c);
    }
    return coarse;
  }

  [[nodiscard]] bool atApex(const Block& block, const Vec2& uv) const {
    const Domain& d = surface_.patchDomain(block.patch);
    const auto is = [&](Side side) { return surface_.topology().edge(block.patch, side).kind == Edge::Apex; };
    return (uv.x == d.u.lo && is(Side::UMin)) || (uv.x == d.u.hi && is(Side::UMax)) ||
           (uv.y == d.v.lo && is(Side::VMin)) || (uv.y == d.v.hi && is(Side::VMax));
  }

  /// Largest angle between a triangle's normal and the direction in which a corner moves. An apex stays one
  /// however small the cells are.
  [[nodiscard]] double turnOf(std::size_t t, const Block& block) const {
    double least = 1;
    for (const std::uint32_t v : frame_.corners(t))
      if (!atApex(block, mesh_.parameters[v]))
        least = std::min(least, glm::dot(frame_.facet(t), unit(moves_[frame_.pointOf(v)])));
    return angleOf(least);
  }

  static double angleOf(double cosine) { return std::acos(std::clamp(cosine, -1.0, 1.0)); }

  /// How far the slab is from a triangle, on the farther side.
  [[nodiscard]] double heightOf(std::size_t t) const {
    return std::max(frame_.heights().above[t], frame_.heights().below[t]);
  }

  /// How much shorter an edge becomes on one of the two sides, in parts of it: above 1 it turns over.
  [[nodiscard]] double shrinkingOf(std::size_t t) const {
    const auto corners = frame_.corners(t);
    double most = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t i = corners[k], j = corners[(k + 1) % 3];
      const double change = glm::length(moves_[frame_.pointOf(j)] - moves_[frame_.pointOf(i)]);
      const double length = glm::length(mesh_.positions[j] - mesh_.positions[i]);
      most = std::max(most, heightOf(t) * change / length);
    }
    return most;
  }

  /// Angles between the normals of its corners, along edges that lead along u and along v.
  [[nodiscard]] Vec2 turnsAlong(std::size_t t, const Block& block) const {
    constexpr double kAlong = 1.5;
    const Domain cell = domainOf(block.tile, surface_.patchDomain(block.patch));
    const Vec2 extent(cell.u.width() / block.segments.u, cell.v.width() / block.segments.v);
    const auto corners = frame_.corners(t);
    Vec2 turns(0);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t i = corners[k], j = corners[(k + 1) % 3];
      const Vec2 step = glm::abs(mesh_.parameters[j] - mesh_.parameters[i]) / extent;
      const double turn = std::acos(std::clamp(glm::dot(mesh_.normals[i], mesh_.normals[j]), -1.0, 1.0));
      if (step.x > kAlong * step.y) turns.x = std::max(turns.x, turn);
      if (step.y > kAlong * step.x) turns.y = std::max(turns.y, turn);
    }
    return turns;
  }

  [[nodiscard]] Vec2 centerOf(std::size_t t, std::uint32_t patch) const {
    const Domain& d = surface_.patchDomain(patch);
    const auto [a, b, c] = frame_.corners(t);
    const Vec2 center = (mesh_.parameters[a] + mesh_.parameters[b] + mesh_.parameters[c]) / 3.0;
    return {(center.x - d.u.lo) / d.u.width(), (center.y - d.v.lo) / d.v.width()};
  }

  /// Halves blocks until they are mostly too coarse, then raises their segments.
  void refine(const Block& block, std::vector<Coarse> coarse) {
    const auto [nu, nv] = block.segments;
    const double all = 2.0 * nu * nv;
    const bool acrossU = nu >= nv;
    const bool little = std::ranges::all_of(coarse, [](const Coarse& c) { return c.excess < kLittle; });
    if (coarse.empty()) {
      refined_.push_back(block);
    } else if (static_cast<double>(coarse.size()) > kMostly * all || std::max(nu, nv) < 2 ||
               (little && nu * nv <= kFewCells) || !divisible(block.tile, acrossU)) {
      raise(block, coarse);
    } else {
      const std::array<Block, 2> halves = halvesOf(block, acrossU);
      std::array<std::vector<Coarse>, 2> parts;
      const double middle = acrossU ? halves[0].tile.highU() : halves[0].tile.highV();
      for (const Coarse& c : coarse) parts[(acrossU ? c.center.x : c.center.y) > middle].push_back(c);
      for (std::size_t k = 0; k < 2; ++k) refine(halves[k], std::move(parts[k]));
    }
  }

  static bool divisible(const Tile& tile, bool acrossU) {
    return (acrossU ? tile.levelU : tile.levelV) < kDeepest;
  }

  /// With cells no larger than the block's.
  static std::array<Block, 2> halvesOf(const Block& block, bool acrossU) {
    std::array<Block, 2> halves{block, block};
    const auto tiles = block.tile.halves(acrossU);
    for (std::size_t k = 0; k < 2; ++k) {
      halves[k].tile = tiles[k];
      std::uint32_t& segments = acrossU ? halves[k].segments.u : halves[k].segments.v;
      segments = (segments + 1) / 2;
    }
    return halves;
  }

  void raise(Block block, const std::vector<Coarse>& coarse) {
    double u = 1, v = 1;
    for (const Coarse& c : coarse) {
      if (c.u) u = std::max(u, c.excess);
      if (c.v) v = std::max(v, c.excess);
    }
    const auto raised = [](std::uint32_t segments, double excess) {
      const double wanted = std::ceil(segments * std::min(excess, 2.0));
      return static_cast<std::uint32_t>(std::min<double>(wanted, kMaxSegments));
    };
    const Domain& domain = surface_.patchDomain(block.patch);
    const Domain cell = domainOf(block.tile, domain);
    const Curvature c = curvatureOf(surface_, block.patch, domain, cell, parameters_);
    if (!c.proven()) {
      cut(block, u > 1, v > 1);
      return;
    }
    block.segments = {raised(block.segments.u, u), raised(block.segments.v, v)};
    const double deviation =
        c.deviation(block.tile.widthU() / block.segments.u, block.tile.widthV() / block.segments.v);
    if (deviation <= block.bound) {
      block.bound = deviation;
      block.boxed = false;
    }
    refined_.push_back(block);
  }

  /// Where nothing is known of the second derivatives, only smaller boxes help.
  void cut(const Block& block, bool acrossU, bool acrossV) {
    if (acrossU && divisible(block.tile, true)) {
      for (const Block& half : halvesOf(block, true)) cut(half, false, acrossV);
    } else if (acrossV && divisible(block.tile, false)) {
      for (const Block& half : halvesOf(block, false)) cut(half, false, false);
    } else {
      refined_.push_back(block);
      Block& last = refined_.back();
      const Domain cell = domainOf(last.tile, surface_.patchDomain(last.patch));
      const double diameter = glm::length(surface_.boundPosition(last.patch, cell, parameters_).extent());
      if (diameter < last.bound) {
        last.bound = diameter;
        last.boxed = true;
      }
    }
  }

  const Surface& surface_;
  std::span<const double> parameters_;
  const ShellDesc& desc_;
  const ShellFrame& frame_;
  const Mesh& mesh_;
  std::vector<Vec3> moves_;  // of points, without walls
  std::vector<Block> refined_;
};

}  // namespace

bool refineForShell(const Surface& surface, std::span<const double> parameters, const ShellDesc& desc,
                    const ShellFrame& frame, std::vector<Block>& blocks) {
  return Refinement(surface, parameters, desc, frame).refine(blocks);
}

}  // namespace luxo
