// SPDX-License-Identifier: Apache-2.0
#include "shell/shell_frame.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <unordered_set>

#include "surface/period.h"
#include "tessellate/block_mesh.h"

namespace luxo {
namespace {

/// Triangles with less area than this part of their longest edge's square have no direction.
constexpr double kSliver = 1e-9;
/// No vertex moves farther than this many times the distance to keep; where that leads nowhere, as far as
/// the other.
constexpr double kLongestMove = 8, kStrayMove = 2;

/// What is known of each patch alone.
class PatchReader {
 public:
  PatchReader(const Surface& surface, std::span<const double> parameters, double size)
      : surface_(surface), parameters_(parameters), tolerance_(1e-9 * size) {}

  [[nodiscard]] ShellPatch read(std::uint32_t patch) const {
    const auto collapsed = [&](Side side) { return surface_.topology().edge(patch, side).collapsed(); };
    return {.domain = surface_.patchDomain(patch),
            .wrapsU = joined(patch, Side::UMin, Side::UMax) && goesOn(patch, true),
            .wrapsV = joined(patch, Side::VMin, Side::VMax) && goesOn(patch, false),
            .collapsedUMin = collapsed(Side::UMin),
            .collapsedUMax = collapsed(Side::UMax),
            .collapsedVMin = collapsed(Side::VMin),
            .collapsedVMax = collapsed(Side::VMax),
            .bordered = std::ranges::any_of(surface_.topology().edges[patch],
                                            [](const EdgeKind& edge) { return edge.kind == Edge::Border; }),
            .orientation = surface_.topology().orientation(patch)};
  }

 private:
  [[nodiscard]] bool joined(std::uint32_t patch, Side lower, Side upper) const {
    const PatchEdge a{patch, lower}, b{patch, upper};
    return std::ranges::any_of(surface_.topology().joints, [&](const Joint& j) {
      return j.smooth && !j.flipped && !j.reversed && ((j.a == a && j.b == b) || (j.a == b && j.b == a));
    });
  }

  /// Whether the formula has a period (surface/period.h) that is the width of u (of v), as near as its points
  /// tell.
  [[nodiscard]] bool goesOn(std::uint32_t patch, bool alongU) const {
    return isThereAgain(patch, alongU) && hasPeriod(surface_.patches()[patch], parameters_, alongU);
  }

  /// Beyond each end are the points at the other end.
  [[nodiscard]] bool isThereAgain(std::uint32_t patch, bool alongU) const {
    const Domain& domain = surface_.patchDomain(patch);
    const Interval &along = alongU ? domain.u : domain.v, &across = alongU ? domain.v : domain.u;
    std::vector<double> beyond, inside, at;
    for (const double part : {0.003, 0.031, 0.11, 0.2}) {
      const double x = part * along.width();
      beyond.insert(beyond.end(), {along.hi + x, along.lo - x});
      inside.insert(inside.end(), {along.lo + x, along.hi - x});
    }
    for (const double part : {0.0, 0.13, 0.37, 0.5, 0.71, 0.94, 1.0}) at.push_back(parameterAt(across, part));
    const auto points = [&](const std::vector<double>& where) {
      return alongU ? surface_.evaluateGrid(patch, where, at, parameters_).position
                    : surface_.evaluateGrid(patch, at, where, parameters_).position;
    };
    const std::vector<Vec3> a = points(beyond), b = points(inside);
    for (std::size_t i = 0; i < a.size(); ++i)
      if (!(glm::length(a[i] - b[i]) <= tolerance_)) return false;
    return true;
  }

  const Surface& surface_;
  std::span<const double> parameters_;
  double tolerance_;
};

std::uint64_t hashOf(const Vec2& p) {
  return std::bit_cast<std::uint64_t>(p.x) * 0x9e3779b97f4a7c15u ^ std::bit_cast<std::uint64_t>(p.y);
}

bool onEdge(const Vec2& p, const Domain& d) {
  return p.x == d.u.lo || p.x == d.u.hi || p.y == d.v.lo || p.y == d.v.hi;
}

/// One (u, v) for all that are the same place. The ends of collapsed edges are those that collapsed edges
/// beside them have too.
Vec2 canonical(Vec2 p, const ShellPatch& patch) {
  const Domain& d = patch.domain;
  if (patch.wrapsU && p.x == d.u.hi) p.x = d.u.lo;
  if (patch.wrapsV && p.y == d.v.hi) p.y = d.v.lo;
  if ((patch.collapsedVMin && p.y == d.v.lo) || (patch.collapsedVMax && p.y == d.v.hi))
    p.x = patch.collapsedUMax ? d.u.hi : d.u.lo;
  if ((patch.collapsedUMin && p.x == d.u.lo) || (patch.collapsedUMax && p.x == d.u.hi)) p.y = d.v.lo;
  return p + 0.0;  // -0 is 0
}

}  // namespace

Curvature curvatureAround(const CurvatureMap& map, std::uint32_t patch, const Vec2& low, const Vec2& high) {
  struct Span {
    std::uint32_t level = 0, first = 0, last = 0;
  };
  const auto span = [](double from, double to, std::uint32_t finest) {
    Span s;
    while (s.level < finest && std::ldexp(to - from, static_cast<int>(s.level) + 1) <= 1) ++s.level;
    const double count = std::ldexp(1.0, static_cast<int>(s.level));
    // A rounding error beyond a border of tiles may be either side.
    s.first = static_cast<std::uint32_t>(std::clamp(std::floor(from * count - 1e-9), 0.0, count - 1));
    s.last = static_cast<std::uint32_t>(std::clamp(std::floor(to * count + 1e-9), 0.0, count - 1));
    return s;
  };
  const Span u = span(low.x, high.x, map.levelU()), v = span(low.y, high.y, map.levelV());
  Curvature most;
  for (std::uint32_t column = u.first; column <= u.last; ++column)
    for (std::uint32_t row = v.first; row <= v.last; ++row)
      most = larger(most, map.over(patch, {u.level, v.level, column, row}));
  return most;
}

ShellPatch readPatch(const Surface& surface, std::uint32_t patch, std::span<const double> parameters,
                     double size) {
  return PatchReader(surface, parameters, size).read(patch);
}

Move shortestMove(std::span<const Vec3> facets, std::span<const Vec3> walls, double side,
                  const Clearance& clearance) {
  constexpr int kSweeps = 100;
  constexpr double kAlmost = 1 - 1e-3;
  const std::size_t count = facets.size() + walls.size();
  if (count == 0) return {};
  const auto normal = [&](std::size_t i) {
    return i < facets.size() ? side * facets[i] : walls[i - facets.size()];
  };
  const double farthest = walls.empty() ? clearance.facets : std::max(clearance.facets, clearance.walls);
  // In parts of the farthest.
  const auto wanted = [&](std::size_t i) {
    return (i < facets.size() ? clearance.facets : clearance.walls) / farthest;
  };
  std::vector<double> weights(count, 0.0);
  Vec3 d(0);
  double least = 0;
  for (int sweep = 0; sweep < kSweeps && least < kAlmost; ++sweep) {
    for (std::size_t i = 0; i < count; ++i) {
      const double change = std::max(-weights[i], wanted(i) - glm::dot(normal(i), d));
      weights[i] += change;
      d += change * normal(i);
    }
    least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < count; ++i) least = std::min(least, glm::dot(normal(i), d) / wanted(i));
  }
  const double length = glm::length(d);
  if (least > 0 && length <= kLongestMove * least) return {d * (farthest / least), true};
  return {unit(d) * (kStrayMove * farthest), false};
}

ShellFrame::ShellFrame(const Surface& surface, std::span<const double> parameters, const CurvatureMap& map,
                       const std::vector<Block>& blocks, const std::vector<ShellPatch>& patches,
                       ShellLook& look)
    : mesh_(meshOfBlocks(surface, parameters, blocks, &firstIndices_)) {
  Box box;
  for (const Vec3& p : mesh_.positions) box.add(p);
  size_ = box.empty() ? 0 : glm::length(box.extent());
  numberPoints(blocks, patches);
  findFacets();
  findWalls(patches);
  fileByPoint();
  findBounds(map, blocks, patches);
  heights_ = look.heightsOf(*this);
}

void ShellFrame::numberPoints(const std::vector<Block>& blocks, const std::vector<ShellPatch>& patches) {
  patches_.resize(mesh_.positions.size());
  for (std::size_t b = 0; b < blocks.size(); ++b)
    for (std::size_t i = firstIndices_[b]; i < firstIndices_[b + 1]; ++i)
      patches_[mesh_.indices[i]] = blocks[b].patch;
  points_.resize(mesh_.positions.size());
  // Vertices of a patch are consecutive.
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> onEdges;
  for (std::uint32_t v = 0; v < points_.size(); ++v) {
    const ShellPatch& patch = patches[patches_[v]];
    if (v > 0 && patches_[v] != patches_[v - 1]) onEdges.clear();
    const Vec2 place = canonical(mesh_.parameters[v], patch);
    if (!onEdge(place, patch.domain)) {
      points_[v] = static_cast<std::uint32_t>(pointCount_++);
      continue;
    }
    std::vector<std::uint32_t>& here = onEdges[hashOf(place)];
    const auto same = std::ranges::find_if(
        here, [&](std::uint32_t other) { return canonical(mesh_.parameters[other], patch) == place; });
    points_[v] = same != here.end() ? points_[*same] : static_cast<std::uint32_t>(pointCount_++);
    if (same == here.end()) here.push_back(v);
  }
}

void ShellFrame::findFacets() {
  facets_.reserve(mesh_.triangleCount());
  for (std::size_t t = 0; t < mesh_.triangleCount(); ++t) {
    const auto [a, b, c] = corners(t);
    const Vec3 ab = mesh_.positions[b] - mesh_.positions[a], ac = mesh_.positions[c] - mesh_.positions[a];
    const double longest = std::max({glm::dot(ab, ab), glm::dot(ac, ac), glm::dot(ac - ab, ac - ab)});
    const Vec3 normal = glm::cross(ab, ac);
    facets_.push_back(glm::length(normal) > kSliver * longest ? unit(normal) : Vec3(0));
  }
}

void ShellFrame::findWalls(const std::vector<ShellPatch>& patches) {
  const auto key = [&](std::uint32_t a, std::uint32_t b) {
    return (std::uint64_t{points_[a]} << 32) | points_[b];
  };
  // Where no triangle is missing, walls stand on the patches' edges only.
  const auto candidate = [&](std::uint32_t v) {
    return mesh_.dropped > 0 || onEdge(mesh_.parameters[v], patches[patches_[v]].domain);
  };
  const auto forEachCandidate = [&](const auto& action) {
    for (std::size_t t = 0; t < mesh_.triangleCount(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = mesh_.indices[3 * t + k], b = mesh_.indices[3 * t + (k + 1) % 3];
        if (candidate(a) && candidate(b)) action(t, a, b);
      }
  };
  std::unordered_set<std::uint64_t> directed;
  forEachCandidate([&](std::size_t, std::uint32_t a, std::uint32_t b) { directed.insert(key(a, b)); });
  forEachCandidate([&](std::size_t t, std::uint32_t a, std::uint32_t b) {
    if (directed.contains(key(b, a))) return;
    walls_.push_back({a, b, t});
    wallNormals_.push_back(unit(glm::cross(mesh_.positions[b] - mesh_.positions[a], facets_[t])));
  });
}

void ShellFrame::fileByPoint() {
  first_.assign(2 * pointCount_ + 1, 0);
  const auto forEachNormal = [&](const auto& action) {
    for (std::size_t t = 0; t < facets_.size(); ++t)
      if (facets_[t] != Vec3(0))
        for (const std::uint32_t v : corners(t)) action(2 * points_[v], facets_[t]);
    for (std::size_t w = 0; w < walls_.size(); ++w)
      if (wallNormals_[w] != Vec3(0))
        for (const std::uint32_t v : {walls_[w].from, walls_[w].to})
          action(2 * points_[v] + 1, wallNormals_[w]);
  };
  forEachNormal([&](std::size_t place, const Vec3&) { ++first_[place + 1]; });
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  around_.resize(first_.back());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  forEachNormal([&](std::size_t place, const Vec3& normal) { around_[next[place]++] = normal; });
}

void ShellFrame::findBounds(const CurvatureMap& map, const std::vector<Block>& blocks,
                            const std::vector<ShellPatch>& patches) {
  bounds_.reserve(mesh_.triangleCount());
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const Domain& domain = patches[blocks[b].patch].domain;
    for (std::size_t t = firstTriangle(b); t < firstTriangle(b + 1); ++t) {
      const auto part = [&](std::size_t k) {
        const Vec2& uv = mesh_.parameters[mesh_.indices[3 * t + k]];
        return Vec2((uv.x - domain.u.lo) / domain.u.width(), (uv.y - domain.v.lo) / domain.v.width());
      };
      const Vec2 low = glm::min(glm::min(part(0), part(1)), part(2));
      const Vec2 high = glm::max(glm::max(part(0), part(1)), part(2));
      const double bound =
          curvatureAround(map, blocks[b].patch, low, high).deviation(high.x - low.x, high.y - low.y);
      const bool byBlock = !(bound < blocks[b].bound);
      bounds_.push_back(byBlock ? blocks[b].bound : bound);
      smooth_.push_back(std::isfinite(bound) && !(byBlock && blocks[b].boxed) && facets_[t] != Vec3(0));
    }
  }
}

}  // namespace luxo
