// SPDX-License-Identifier: Apache-2.0
#include "shell/shell_occluder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <utility>

#include "math/disjoint_sets.h"
#include "shell/shell.h"
#include "shell/shell_frame.h"

namespace luxo {
namespace {

/// Of the surface's size: places that differ by less are one. Which rounding sets apart stays apart.
constexpr double kSamePlace = 1e-7;
/// Cosine of the angle between two triangles, beyond which their patches do not go on in each other.
constexpr double kSharpest = 0.5;
/// Of a triangle's area, where its vertices span a slab; and the sine of the angle at which its vertices move
/// out of it, at least: more than what is rounded.
constexpr double kLeastLeft = 0.25, kUpright = 1e-6;

/// Pairs of walls that stand back to back, and on no third one, where the surface goes on smoothly.
std::vector<std::pair<std::size_t, std::size_t>> jointsOf(const ShellFrame& frame) {
  using Rounded = std::array<double, 3>;
  const double unit = kSamePlace * frame.size();
  const auto placeOf = [&](std::uint32_t vertex) {
    const Vec3& p = frame.mesh().positions[vertex];
    return Rounded{std::round(p.x / unit) + 0.0, std::round(p.y / unit) + 0.0, std::round(p.z / unit) + 0.0};
  };
  std::map<std::pair<Rounded, Rounded>, std::vector<std::size_t>> walls;
  for (std::size_t w = 0; w < frame.walls().size(); ++w)
    walls[{placeOf(frame.walls()[w].from), placeOf(frame.walls()[w].to)}].push_back(w);
  std::vector<std::pair<std::size_t, std::size_t>> joints;
  for (const auto& [ends, there] : walls) {
    const auto opposite = walls.find({ends.second, ends.first});
    if (!(ends.first < ends.second) || opposite == walls.end()) continue;
    if (there.size() != 1 || opposite->second.size() != 1) continue;
    const std::size_t a = there[0], b = opposite->second[0];
    const auto facetOf = [&](std::size_t w) { return frame.facet(frame.walls()[w].triangle); };
    if (glm::dot(facetOf(a), facetOf(b)) > kSharpest) joints.emplace_back(a, b);
  }
  return joints;
}

/// Where the vertices are, and which patches share a slab.
class OccluderBuilder {
 public:
  OccluderBuilder(const Shell& shell, const ShellFrame& frame, std::span<const std::size_t> sources)
      : shell_(shell), frame_(frame), sources_(sources), mesh_(frame.mesh()) {}

  ShellOccluder build(std::span<const Distances> distances) {
    place(distances);
    classify();
    return std::move(occluder_);
  }

 private:
  void place(std::span<const Distances> distances) {
    const std::vector<ShellFrame::WallEdge>& walls = frame_.walls();
    const auto patchCount = static_cast<std::uint32_t>(shell_.patchData.size());
    joined_.resize(walls.size());
    DisjointSets points(frame_.pointCount()), patches(patchCount);
    for (const auto& [a, b] : jointsOf(frame_)) {
      joined_[a] = joined_[b] = true;
      points.unite(frame_.pointOf(walls[a].from), frame_.pointOf(walls[b].to));
      points.unite(frame_.pointOf(walls[a].to), frame_.pointOf(walls[b].from));
      patches.unite(frame_.patchOf(walls[a].from), frame_.patchOf(walls[b].from));
    }
    for (std::uint32_t patch = 0; patch < patchCount; ++patch)
      occluder_.slabOf.push_back(patches.find(patch).number);

    // What stands around points at walls and joints, in one list for all that are one place.
    struct Around {
      std::vector<Vec3> facets, walls;  // normals, those of walls turned inward
      Distances distances;
      Vec3 out{0}, in{0};  // where they lead to
    };
    std::map<std::uint32_t, Around> places;
    for (const ShellFrame::WallEdge& wall : walls)
      for (const std::uint32_t vertex : {wall.from, wall.to})
        places[points.find(frame_.pointOf(vertex)).number];
    for (std::uint32_t point = 0; point < frame_.pointCount(); ++point) {
      const auto place = places.find(points.find(point).number);
      if (place == places.end()) continue;
      Around& around = place->second;
      const auto facets = frame_.facetsAround(point);
      around.facets.insert(around.facets.end(), facets.begin(), facets.end());
      Distances& d = around.distances;
      d = {.out = std::max(d.out, distances[point].out),
           .in = std::max(d.in, distances[point].in),
           .within = std::max(d.within, distances[point].within)};
    }
    for (std::size_t w = 0; w < walls.size(); ++w)
      if (!joined_[w])
        for (const std::uint32_t vertex : {walls[w].from, walls[w].to})
          places[points.find(frame_.pointOf(vertex)).number].walls.push_back(-frame_.wallNormal(w));

    occluder_.proven = shell_.proven;
    for (auto& [place, around] : places) {
      const Distances& d = around.distances;
      const Move out = shortestMove(around.facets, around.walls, 1, {d.out, d.within});
      const Move in = shortestMove(around.facets, around.walls, -1, {d.in, d.within});
      around.out = out.way;
      around.in = in.way;
      occluder_.proven = occluder_.proven && out.leadsOut && in.leadsOut;
    }
    occluder_.positions = shell_.positions;
    const std::vector<Vec3>& on = mesh_.positions;
    for (std::uint32_t v = 0; v < on.size(); ++v) {
      const auto place = places.find(points.find(frame_.pointOf(v)).number);
      if (place == places.end()) continue;
      occluder_.positions[v] = on[v] + place->second.out;
      occluder_.positions[on.size() + v] = on[v] + place->second.in;
    }
  }

  void classify() {
    occluder_.slabs.resize(occluder_.slabOf.size());
    for (const Shell::Part& part : shell_.parts)
      for (std::uint32_t i = part.firstIndex; i < part.firstIndex + part.count; i += 3) {
        const bool isWall = i >= part.wallIndex() && i < part.bottomIndex();
        const auto what = isWall ? wall(sources_[i / 3]) : triangle(sources_[i / 3]);
        occluder_.triangles.push_back(what);
        if (what == ShellOccluder::Triangle::Joint) continue;
        ShellOccluder::Slab& slab = occluder_.slabs[occluder_.slabOf[shell_.patches[shell_.indices[i]]]];
        (i < part.wallIndex() ? slab.tops : isWall ? slab.walls : slab.bottoms).push_back(i);
      }
  }

  /// A prism's Jacobian, times the way from bottom to top, is the way times the area of the triangle between
  /// them: linear across the triangle and quadratic from bottom to top, so that it is positive where its nine
  /// coefficients (Bernstein's) are. And of the areas some part is to be left.
  [[nodiscard]] ShellOccluder::Triangle triangle(std::size_t number) const {
    const auto c = frame_.corners(number);
    const auto side = [&](const std::vector<Vec3>& points, std::size_t first, std::size_t k) {
      return points[first + c[k]] - points[first + c[0]];
    };
    const std::vector<Vec3>& occluder = occluder_.positions;
    const std::size_t count = mesh_.positions.size();
    const Vec3 a = side(occluder, 0, 1), b = side(occluder, 0, 2), under = side(occluder, count, 1),
               under2 = side(occluder, count, 2);
    const double before =
        glm::dot(glm::cross(side(mesh_.positions, 0, 1), side(mesh_.positions, 0, 2)), frame_.facet(number));
    bool upright = before > 0;
    for (const Vec3& area : {glm::cross(a, b), 0.5 * (glm::cross(a, under2) + glm::cross(under, b)),
                             glm::cross(under, under2)}) {
      upright = upright && glm::dot(area, frame_.facet(number)) > kLeastLeft * before;
      for (const std::uint32_t v : c) {
        const Vec3 way = occluder[v] - occluder[count + v];
        upright = upright && glm::dot(area, way) > kUpright * before * glm::length(way);
      }
    }
    return upright ? ShellOccluder::Triangle::Upright : ShellOccluder::Triangle::Turned;
  }

  [[nodiscard]] ShellOccluder::Triangle wall(std::size_t number) const {
    if (joined_[number]) return ShellOccluder::Triangle::Joint;
    const std::uint32_t from = frame_.walls()[number].from, to = frame_.walls()[number].to;
    const auto count = static_cast<std::uint32_t>(mesh_.positions.size());
    const std::vector<Vec3>& occluder = occluder_.positions;
    const auto faces = [&](std::uint32_t bottom) {
      return glm::dot(glm::cross(occluder[from] - occluder[to], occluder[count + bottom] - occluder[to]),
                      frame_.wallNormal(number)) > 0;
    };
    return faces(from) && faces(to) ? ShellOccluder::Triangle::Upright : ShellOccluder::Triangle::Turned;
  }

  const Shell& shell_;
  const ShellFrame& frame_;
  std::span<const std::size_t> sources_;
  const Mesh& mesh_;
  std::vector<bool> joined_;  // of walls: patches go on in each other, no wall is there
  ShellOccluder occluder_;
};

}  // namespace

ShellOccluder occluderOf(const Shell& shell, const ShellFrame& frame, std::span<const Distances> distances,
                         std::span<const std::size_t> sources) {
  return OccluderBuilder(shell, frame, sources).build(distances);
}

}  // namespace luxo
