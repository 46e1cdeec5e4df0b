// SPDX-License-Identifier: Apache-2.0
#include "shell/shell_heights.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>

#include "shell/shell_frame.h"
#include "tessellate/parallel.h"

namespace luxo {
namespace {

/// Edges of triangles are cut into so many parts: what is left of the deviation falls with the square of it.
constexpr int kParts = 4;
/// Triangles that are looked at together.
constexpr std::size_t kBatch = 256, kBatchesForAllCores = 4,
                      kTrianglesForAllCores = kBatch * kBatchesForAllCores;
/// Triangles that a point is followed over: a bound of work. (Of the catalogue 0.3 % of the strays are over
/// more than 32.)
constexpr std::size_t kFarthestWalk = 256;

using Weights = std::array<double, 3>;  // of a triangle's corners

/// A point of a triangle. Edges are known by the corner opposite.
struct Place {
  Weights u{}, v{};
  std::array<bool, 3> onEdge{};
};

/// The corners of a finer mesh, but for those of the triangle itself.
constexpr auto kPlaces = [] {
  std::array<Place, (kParts + 1) * (kParts + 2) / 2 - 3> places{};
  std::size_t count = 0;
  for (int i = 0; i <= kParts; ++i)
    for (int j = 0; i + j <= kParts; ++j) {
      const int k = kParts - i - j;
      if (std::max({i, j, k}) == kParts) continue;
      const Weights weights{1.0 * i / kParts, 1.0 * j / kParts, 1.0 * k / kParts};
      places[count++] = {weights, weights, {i == 0, j == 0, k == 0}};
    }
  return places;
}();

/// Those of a triangle whose first corner stands for all of an edge that is a point, where v is the same: the
/// triangle is a whole cell.
constexpr auto kPlacesAtPole = [] {
  std::array<Place, kParts*(kParts + 1) - 2> places{};
  std::size_t count = 0;
  for (int row = 1; row <= kParts; ++row)
    for (int column = 0; column <= kParts; ++column) {
      if (row == kParts && (column == 0 || column == kParts)) continue;
      const double x = 1.0 * column / kParts, y = 1.0 * row / kParts;
      places[count++] = {
          {0, 1 - x, x}, {1 - y, y / 2, y / 2}, {row == kParts, column == kParts, column == 0}};
    }
  return places;
}();

/// Where a triangle is looked at: nowhere, if that tells nothing of what is between.
struct Pattern {
  std::span<const Place> places;
  std::size_t first = 0;  // the corner that is a place's first
  bool swapped = false;   // a place's u is the triangle's v
};

std::uint32_t cornerOf(const ShellFrame& frame, std::size_t t, std::size_t k) {
  return frame.mesh().indices[3 * t + k % 3];
}

const Vec3& positionOf(const ShellFrame& frame, std::size_t t, std::size_t k) {
  return frame.mesh().positions[cornerOf(frame, t, k)];
}

double heightOver(const ShellFrame& frame, std::size_t t, const Vec3& point) {
  return glm::dot(frame.facet(t), point - positionOf(frame, t, 0));
}

/// In the plane of a triangle, out of it across an edge.
Vec3 outward(const ShellFrame& frame, std::size_t t, std::size_t opposite) {
  return unit(
      glm::cross(positionOf(frame, t, opposite + 2) - positionOf(frame, t, opposite + 1), frame.facet(t)));
}

Pattern patternOf(const ShellFrame& frame, std::size_t t, const ShellPatch& patch) {
  if (!frame.smooth(t)) return {};
  const Domain& d = patch.domain;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto uv = [&](std::size_t i) { return frame.mesh().parameters[cornerOf(frame, t, k + i)]; };
    const bool ofU = (patch.collapsedUMin && uv(0).x == d.u.lo) || (patch.collapsedUMax && uv(0).x == d.u.hi);
    const bool ofV = (patch.collapsedVMin && uv(0).y == d.v.lo) || (patch.collapsedVMax && uv(0).y == d.v.hi);
    if (!ofU && !ofV) continue;
    const bool wholeCell = ofU ? uv(1).x == uv(2).x : uv(1).y == uv(2).y;
    return wholeCell && ofU != ofV ? Pattern{kPlacesAtPole, k, ofU} : Pattern{};
  }
  return {.places = kPlaces};
}

void lookAtOne(const ShellFrame& frame, std::size_t t, const Pattern& pattern, std::span<const Vec3> points,
               double around, TriangleLook& look) {
  std::array<Vec3, 3> away;
  for (std::size_t k = 0; k < 3; ++k) away[k] = outward(frame, t, k);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double height = heightOver(frame, t, points[i]), reach = std::abs(height) + around;
    look.plane.add(height, around);
    bool strays = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const bool onEdge = pattern.places[i].onEdge[(k + 3 - pattern.first) % 3];
      const double outside = glm::dot(away[k], points[i] - positionOf(frame, t, k + 1));
      HeightRange& edge = look.edges[k];
      edge.above = std::max(edge.above, outside + around);
      if (onEdge) edge.below = std::max(edge.below, around - outside);
      strays = strays || (!onEdge && outside > -reach);
    }
    if (strays) look.strays.push_back({points[i], around, reach});
  }
}

/// Points of the finer mesh may be over, or under, more triangles than their own.
class Strays {
 public:
  explicit Strays(const ShellFrame& frame) : frame_(frame) {}

  /// Walks from the triangle across all edges that the point is beyond, or nearly so, as seen from both
  /// sides: calls action(triangle) for those it comes to. `reach`: how far it is from the triangle's plane.
  /// False where there are more than kFarthestWalk.
  template <typename Action>
  [[nodiscard]] bool walk(std::size_t triangle, const Vec3& point, double reach, const Action& action) {
    if (borders_.empty()) joinTriangles();
    ++walk_;
    visited_.assign(1, triangle);
    walkOf_[triangle] = walk_;
    for (std::size_t i = 0; i < visited_.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        const Border& border = borders_[3 * visited_[i] + k];
        if (border.other == kNone || walkOf_[border.other] == walk_ ||
            glm::dot(border.across, point - border.place) < -reach)
          continue;
        if (visited_.size() == kFarthestWalk) return false;
        action(border.other);
        walkOf_[border.other] = walk_;
        visited_.push_back(border.other);
      }
    return true;
  }

 private:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  /// The edge opposite to a corner, from a triangle to the one beside it.
  struct Border {
    std::size_t other = kNone;
    Vec3 across{0}, place{0};  // between the directions out of the two; a point of the edge
  };

  /// An edge, in the direction in which its triangle is at the left.
  struct Edge {
    std::uint32_t to = 0;
    std::size_t triangle = 0, opposite = 0;
  };

  void joinTriangles() {
    const std::size_t count = frame_.mesh().triangleCount();
    // Filed by the point that they lead away from, some six at each: ten times as fast as a hash table.
    std::vector<std::size_t> firstFrom(frame_.pointCount() + 1);
    for (std::size_t i = 0; i < 3 * count; ++i) ++firstFrom[endOf(i / 3, i % 3, 1) + 1];
    std::partial_sum(firstFrom.begin(), firstFrom.end(), firstFrom.begin());
    std::vector<Edge> edges(3 * count);
    std::vector<std::size_t> next(firstFrom.begin(), firstFrom.end() - 1);
    for (std::size_t i = 0; i < 3 * count; ++i)
      edges[next[endOf(i / 3, i % 3, 1)]++] = {endOf(i / 3, i % 3, 2), i / 3, i % 3};
    borders_.resize(3 * count);
    walkOf_.resize(count);
    forEachIndex(count, count >= kTrianglesForAllCores, [&](std::size_t t) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t from = endOf(t, k, 1), to = endOf(t, k, 2);
        for (std::size_t i = firstFrom[to]; i < firstFrom[to + 1]; ++i) {
          const auto& [backTo, other, opposite] = edges[i];
          if (backTo == from)
            borders_[3 * t + k] = {other, unit(outward(frame_, t, k) - outward(frame_, other, opposite)),
                                   positionOf(frame_, other, opposite + 1)};
        }
      }
    });
  }

  /// The point at which an edge begins (1) or ends (2).
  [[nodiscard]] std::uint32_t endOf(std::size_t t, std::size_t opposite, std::size_t end) const {
    return frame_.pointOf(cornerOf(frame_, t, opposite + end));
  }

  const ShellFrame& frame_;
  std::vector<Border> borders_;                // three for each triangle; filled when first asked for
  std::vector<std::size_t> visited_, walkOf_;  // by the last walk; of each triangle, the last to come to it
  std::size_t walk_ = 0;
};

}  // namespace

void HeightRange::add(double height, double around) {
  above = std::max(above, height + around);
  below = std::max(below, around - height);
}

std::size_t ShellLook::HashOf::operator()(const Triangle& triangle) const {
  std::uint64_t hash = triangle.patch;
  for (const double number : triangle.numbers)
    hash = std::rotl(hash, 23) * 0x9e3779b97f4a7c15u ^ std::bit_cast<std::uint64_t>(number);
  return hash ^ hash >> 32;
}

ShellLook::Triangle ShellLook::triangleOf(const ShellFrame& frame, std::size_t t) {
  const auto uv = [&](std::size_t k) { return frame.mesh().parameters[cornerOf(frame, t, k)]; };
  return {frame.patchOf(cornerOf(frame, t, 0)),
          {uv(0).x, uv(0).y, uv(1).x, uv(1).y, uv(2).x, uv(2).y, frame.bound(t)}};
}

ShellHeights ShellLook::heightsOf(const ShellFrame& frame) {
  const std::size_t count = frame.mesh().triangleCount();
  const bool onAllCores = count >= kTrianglesForAllCores;
  std::vector<std::size_t> hashes(count);
  forEachIndex(count, onAllCores, [&](std::size_t t) { hashes[t] = HashOf{}(triangleOf(frame, t)); });
  std::vector<TriangleLook*> looks(count);
  std::vector<char> isNew(count);
  forEachIndex(looks_.size(), onAllCores, [&](std::size_t part) {
    for (std::size_t t = 0; t < count; ++t) {
      if (hashes[t] % looks_.size() != part) continue;
      const auto [entry, inserted] = looks_[part].try_emplace(triangleOf(frame, t));
      isNew[t] = inserted;
      looks[t] = &entry->second;
    }
  });
  std::vector<std::size_t> unknown;
  for (std::size_t t = 0; t < count; ++t)
    if (isNew[t]) unknown.push_back(t);
  const std::size_t batches = (unknown.size() + kBatch - 1) / kBatch;
  forEachIndex(batches, batches >= kBatchesForAllCores, [&](std::size_t batch) {
    const std::size_t first = batch * kBatch;
    lookAt(frame, std::span(unknown).subspan(first, std::min(kBatch, unknown.size() - first)), looks);
  });

  ShellHeights heights;
  for (const TriangleLook* look : looks) {
    heights.above.push_back(look->plane.above);
    heights.below.push_back(look->plane.below);
    heights.alike.push_back(look->alike);
  }
  Strays strays(frame);
  for (std::size_t t = 0; t < count; ++t)
    for (const TriangleLook::Stray& stray : looks[t]->strays) {
      const bool followed = strays.walk(t, stray.point, stray.reach, [&](std::size_t other) {
        const double height = heightOver(frame, other, stray.point);
        heights.above[other] = std::max(heights.above[other], height + stray.around);
        heights.below[other] = std::max(heights.below[other], stray.around - height);
      });
      if (followed) continue;
      heights.unfollowed.push_back(t);
      break;
    }
  for (const ShellFrame::WallEdge& wall : frame.walls()) {
    std::size_t opposite = 0;
    while (cornerOf(frame, wall.triangle, opposite + 1) != wall.from) ++opposite;
    const HeightRange& edge = looks[wall.triangle]->edges[opposite];
    heights.beyond.push_back(edge.above);
    heights.within.push_back(edge.below);
  }
  return heights;
}

/// Triangles of a patch follow each other.
void ShellLook::lookAt(const ShellFrame& frame, std::span<const std::size_t> triangles,
                       std::span<TriangleLook* const> looks) const {
  while (!triangles.empty()) {
    const auto patchOf = [&](std::size_t t) { return frame.patchOf(cornerOf(frame, t, 0)); };
    const std::uint32_t patch = patchOf(triangles[0]);
    std::size_t count = 1;
    while (count < triangles.size() && patchOf(triangles[count]) == patch) ++count;
    lookAt(frame, patch, triangles.first(count), looks);
    triangles = triangles.subspan(count);
  }
}

void ShellLook::lookAt(const ShellFrame& frame, std::uint32_t patch, std::span<const std::size_t> triangles,
                       std::span<TriangleLook* const> looks) const {
  std::vector<double> u, v;
  for (const std::size_t t : triangles) {
    const Pattern pattern = patternOf(frame, t, patches_[patch]);
    for (const Place& place : pattern.places) {
      Vec2 uv(0);
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec2& corner = frame.mesh().parameters[cornerOf(frame, t, pattern.first + k)];
        uv += corner * (pattern.swapped ? Vec2(place.v[k], place.u[k]) : Vec2(place.u[k], place.v[k]));
      }
      u.push_back(uv.x);
      v.push_back(uv.y);
    }
  }
  const SurfacePoints points = surface_.evaluate(patch, u, v, parameters_);
  std::size_t next = 0;
  for (const std::size_t t : triangles) {
    const Pattern pattern = patternOf(frame, t, patches_[patch]);
    TriangleLook& look = *looks[t];
    const auto here = std::span(points.position).subspan(next, pattern.places.size());
    const bool finite =
        std::ranges::all_of(here, [](const Vec3& p) { return std::isfinite(p.x + p.y + p.z); });
    const double around = here.empty() || !finite ? frame.bound(t) : frame.bound(t) / (kParts * kParts);
    look.plane = {around, around};
    look.edges.fill(look.plane);
    if (finite) lookAtOne(frame, t, pattern, here, around, look);
    for (std::size_t i = next; i < next + here.size(); ++i) {
      const Vec3 normal = unit(patches_[patch].orientation * glm::cross(points.du[i], points.dv[i]));
      if (const double cosine = glm::dot(normal, frame.facet(t)); cosine < look.alike && normal != Vec3(0))
        look.alike = cosine;
    }
    next += here.size();
  }
}

}  // namespace luxo
