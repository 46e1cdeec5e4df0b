// SPDX-License-Identifier: Apache-2.0
#include "tessellate/hull.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "base/assert.h"
#include "tessellate/block_plan.h"
#include "tessellate/hull_frame.h"
#include "tessellate/hull_refinement.h"
#include "tessellate/parallel.h"

namespace luxo {
namespace {

/// Bounds hold in real numbers; and a bound that changes from triangle to triangle needs room (see
/// distances()).
constexpr double kSlack = 1.1;
/// Parts of the hull's size: what single precision rounds away, and the thickness of what is flat.
constexpr double kRounding = 1e-6, kThinnest = 1e-4;

constexpr int kMostRefinements = 6;
constexpr std::size_t kMostRefinedTriangles = 200'000;
constexpr std::size_t kPointsForAllCores = 8192;

/// Turns a frame into a hull.
class Builder {
 public:
  Builder(const Surface& surface, const HullFrame& frame, const HullDesc& desc)
      : surface_(surface), frame_(frame), desc_(desc), mesh_(frame.mesh()) {}

  void build(Hull& hull) const {
    hull.bound = mesh_.bound;
    hull.origin = mesh_.origin;
    hull.proven = std::isfinite(mesh_.bound) && mesh_.dropped == 0;
    moveVertices(hull);
    setCells(hull);
    addParts(hull);
  }

 private:
  /// Of each point: the largest bound of the triangles around it, and a little. Where a bound b falls to one
  /// below b across a triangle of height L, the surface that belongs to the neighbour may reach over the edge
  /// by x and stand sqrt(b^2 - x^2) high there, where the plane has come down to b (1 - x / L) at least: at
  /// most b^3 / 2 L^2 too low, which the slack covers for triangles higher than 2.3 b.
  [[nodiscard]] std::vector<double> distances() const {
    const double least = std::min(0.1 * desc_.tolerance, kThinnest * frame_.size());
    std::vector<double> distances(frame_.pointCount(), least);
    for (std::size_t t = 0; t < mesh_.triangleCount(); ++t) {
      const double bound = frame_.bound(t);
      const double distance =
          kSlack * (std::isfinite(bound) ? bound : desc_.tolerance) + kRounding * frame_.size();
      for (std::size_t k = 0; k < 3; ++k) {
        double& largest = distances[frame_.pointOf(mesh_.indices[3 * t + k])];
        largest = std::max(largest, distance);
      }
    }
    return distances;
  }

  void moveVertices(Hull& hull) const {
    const std::vector<double> distance = distances();
    struct Moves {
      Vec3 out{0}, in{0};
      bool leadOut = false;
    };
    std::vector<Moves> moves(frame_.pointCount());
    forEachIndex(moves.size(), moves.size() >= kPointsForAllCores, [&](std::size_t p) {
      const std::span<const Vec3> facets = frame_.facetsAround(p), walls = frame_.wallsAround(p);
      const Move out = shortestMove(facets, walls, 1);
      const Move in = walls.empty() ? Move{-out.direction, out.leadsOut} : shortestMove(facets, walls, -1);
      moves[p] = {distance[p] * out.direction, distance[p] * in.direction, out.leadsOut && in.leadsOut};
    });
    const std::size_t count = mesh_.positions.size();
    hull.positions.resize(2 * count);
    hull.parameters.resize(2 * count);
    hull.patches.resize(2 * count);
    for (std::uint32_t v = 0; v < count; ++v) {
      const Moves& m = moves[frame_.pointOf(v)];
      hull.positions[v] = mesh_.positions[v] + m.out;
      hull.positions[count + v] = mesh_.positions[v] + m.in;
      hull.parameters[v] = hull.parameters[count + v] = mesh_.parameters[v];
      hull.patches[v] = hull.patches[count + v] = frame_.patchOf(v);
      hull.offset = std::max({hull.offset, glm::length(m.out), glm::length(m.in)});
      hull.proven = hull.proven && m.leadOut;
    }
  }

  void setCells(Hull& hull) const {
    const std::size_t count = mesh_.positions.size();
    hull.cells.resize(2 * count, Vec2(0));
    for (std::size_t t = 0; t < mesh_.triangleCount(); ++t) {
      const auto uv = [&](std::size_t k) { return mesh_.parameters[mesh_.indices[3 * t + k]]; };
      const Vec2 low = glm::min(glm::min(uv(0), uv(1)), uv(2)),
                 high = glm::max(glm::max(uv(0), uv(1)), uv(2));
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t v = mesh_.indices[3 * t + k];
        hull.cells[v] = hull.cells[count + v] = glm::max(hull.cells[v], high - low);
      }
    }
  }

  void addParts(Hull& hull) const {
    std::vector<bool> done(surface_.patchCount());
    for (std::uint32_t patch = 0; patch < surface_.patchCount(); ++patch) {
      if (done[patch]) continue;
      std::vector<bool> inPart(surface_.patchCount());
      for (std::uint32_t other = patch; other < surface_.patchCount(); ++other)
        if (surface_.patches()[other].function == surface_.patches()[patch].function)
          inPart[other] = done[other] = true;
      addPart(hull, patch, inPart);
    }
  }

  void addPart(Hull& hull, std::uint32_t patch, const std::vector<bool>& inPart) const {
    const auto count = static_cast<std::uint32_t>(mesh_.positions.size());
    std::vector<std::uint32_t>& indices = hull.indices;
    const auto size = [&] { return static_cast<std::uint32_t>(indices.size()); };
    const auto forEachTriangle = [&](const auto& action) {
      for (std::size_t i = 0; i < mesh_.indices.size(); i += 3)
        if (inPart[frame_.patchOf(mesh_.indices[i])])
          action(mesh_.indices[i], mesh_.indices[i + 1], mesh_.indices[i + 2]);
    };
    Hull::Part part{.patch = patch, .firstIndex = size()};
    forEachTriangle([&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      indices.insert(indices.end(), {a, b, c});
    });
    for (const HullFrame::WallEdge& wall : frame_.walls()) {
      if (!inPart[frame_.patchOf(wall.from)]) continue;
      const std::uint32_t a = wall.from, b = wall.to;
      indices.insert(indices.end(), {b, a, count + a, b, count + a, count + b});
    }
    part.frontCount = size() - part.firstIndex;
    forEachTriangle([&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      indices.insert(indices.end(), {count + a, count + c, count + b});
    });
    part.count = size() - part.firstIndex;
    if (part.count > 0) hull.parts.push_back(part);
  }

  const Surface& surface_;
  const HullFrame& frame_;
  const HullDesc& desc_;
  const Mesh& mesh_;
};

}  // namespace

Hull makeHull(const Surface& surface, std::span<const double> parameters, const CurvatureMap& map,
              const HullDesc& desc) {
  LUXO_REQUIRE_COMPARE(desc.tolerance, >, 0.0);
  std::vector<Block> blocks = planBlocks(surface, parameters, map, {.tolerance = desc.tolerance});
  std::ranges::stable_sort(blocks, {}, &Block::patch);

  Hull hull;
  const Box box = surface.framing(parameters);
  const double size = box.empty() ? 0 : glm::length(box.extent());
  for (std::uint32_t patch = 0; patch < surface.patchCount(); ++patch)
    hull.patchData.push_back(readPatch(surface, patch, parameters, size));

  auto frame = std::make_unique<HullFrame>(surface, parameters, map, blocks, hull.patchData);
  for (int k = 0; k < kMostRefinements && frame->mesh().triangleCount() < kMostRefinedTriangles; ++k) {
    if (!refineForHull(surface, parameters, desc, *frame, blocks)) break;
    frame = std::make_unique<HullFrame>(surface, parameters, map, blocks, hull.patchData);
  }
  Builder(surface, *frame, desc).build(hull);
  return hull;
}

}  // namespace luxo
