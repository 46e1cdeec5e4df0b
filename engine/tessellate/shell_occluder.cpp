// SPDX-License-Identifier: Apache-2.0
#include "tessellate/shell_occluder.h"
#include "math/disjoint_sets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <utility>

namespace luxo {
namespace {

/// Of the surface's size: places that differ by less are one. Which rounding sets apart stays apart.
constexpr double kSamePlace = 1e-7;
/// Cosine of the angle between two triangles, beyond which their patches do not go on in each other.
constexpr double kSharpest = 0.5;

/// Pairs of walls that stand back to back, and on no third one, where the surface goes on smoothly.
std::vector<std::pair<std::size_t, std::size_t>> jointsOf(const ShellFrame& frame) {
  using Place = std::array<double, 3>;
  const double unit = kSamePlace * frame.size();
  const auto placeOf = [&](std::uint32_t vertex) {
    const Vec3& p = frame.mesh().positions[vertex];
    return Place{std::round(p.x / unit) + 0.0, std::round(p.y / unit) + 0.0, std::round(p.z / unit) + 0.0};
  };
  std::map<std::pair<Place, Place>, std::vector<std::size_t>> walls;
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

}  // namespace

ShellOccluder occluderOf(const ShellFrame& frame, std::span<const Distances> distances,
                         std::span<const Vec3> positions, std::uint32_t patchCount) {
  const std::vector<ShellFrame::WallEdge>& walls = frame.walls();
  ShellOccluder spans;
  spans.joined.resize(walls.size());
  DisjointSets points(frame.pointCount()), patches(patchCount);
  for (const auto& [a, b] : jointsOf(frame)) {
    spans.joined[a] = spans.joined[b] = true;
    points.unite(frame.pointOf(walls[a].from), frame.pointOf(walls[b].to));
    points.unite(frame.pointOf(walls[a].to), frame.pointOf(walls[b].from));
    patches.unite(frame.patchOf(walls[a].from), frame.patchOf(walls[b].from));
  }
  for (std::uint32_t patch = 0; patch < patchCount; ++patch)
    spans.slabs.push_back(patches.find(patch).number);

  // What stands around points at walls and joints, in one list for all that are one place.
  struct Around {
    std::vector<Vec3> facets, walls;  // normals, those of walls turned inward
    Distances distances;
    Vec3 out{0}, in{0};  // where they lead to
  };
  std::map<std::uint32_t, Around> places;
  for (const ShellFrame::WallEdge& wall : walls)
    for (const std::uint32_t vertex : {wall.from, wall.to}) places[points.find(frame.pointOf(vertex)).number];
  for (std::uint32_t point = 0; point < frame.pointCount(); ++point) {
    const auto place = places.find(points.find(point).number);
    if (place == places.end()) continue;
    Around& around = place->second;
    const auto facets = frame.facetsAround(point);
    around.facets.insert(around.facets.end(), facets.begin(), facets.end());
    Distances& d = around.distances;
    d = {.out = std::max(d.out, distances[point].out),
         .in = std::max(d.in, distances[point].in),
         .within = std::max(d.within, distances[point].within)};
  }
  for (std::size_t w = 0; w < walls.size(); ++w)
    if (!spans.joined[w])
      for (const std::uint32_t vertex : {walls[w].from, walls[w].to})
        places[points.find(frame.pointOf(vertex)).number].walls.push_back(-frame.wallNormal(w));

  for (auto& [place, around] : places) {
    const Distances& d = around.distances;
    const Move out = shortestMove(around.facets, around.walls, 1, {d.out, d.within});
    const Move in = shortestMove(around.facets, around.walls, -1, {d.in, d.within});
    around.out = out.way;
    around.in = in.way;
    spans.proven = spans.proven && out.leadsOut && in.leadsOut;
  }
  spans.positions.assign(positions.begin(), positions.end());
  const std::vector<Vec3>& on = frame.mesh().positions;
  for (std::uint32_t v = 0; v < on.size(); ++v) {
    const auto place = places.find(points.find(frame.pointOf(v)).number);
    if (place == places.end()) continue;
    spans.positions[v] = on[v] + place->second.out;
    spans.positions[on.size() + v] = on[v] + place->second.in;
  }
  return spans;
}

}  // namespace luxo
