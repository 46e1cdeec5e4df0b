// SPDX-License-Identifier: Apache-2.0
#include "tessellate/hull.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>

#include "base/assert.h"
#include "tessellate/block_mesh.h"
#include "tessellate/block_plan.h"
#include "tessellate/parallel.h"

namespace luxo {
namespace {

/// Bounds hold in real numbers; and a bound that changes from block to block needs room (see distances()).
constexpr double kSlack = 1.1;
/// Parts of the hull's size: what single precision rounds away, and the thickness of what is flat.
constexpr double kRounding = 1e-6, kThinnest = 1e-4;
/// No vertex moves farther than this many times its distance: beyond, corners are cut.
constexpr double kLongestMove = 8;
/// Triangles with less area than this part of their longest edge's square have no direction.
constexpr double kSliver = 1e-9;

constexpr int kMostRefinements = 6;
constexpr std::size_t kMostRefinedTriangles = 200'000;
constexpr double kWorthRefining = 0.9;

constexpr std::size_t kPointsForAllCores = 8192;

/// What is known of each patch alone.
class PatchReader {
 public:
  PatchReader(const Surface& surface, std::span<const double> parameters, double size)
      : surface_(surface), parameters_(parameters), tolerance_(1e-9 * size) {}

  [[nodiscard]] HullPatch read(std::uint32_t patch) const {
    const auto collapsed = [&](Side side) { return surface_.topology().edge(patch, side).collapsed(); };
    return {.domain = surface_.patchDomain(patch),
            .wrapsU = joined(patch, Side::UMin, Side::UMax) && goesOn(patch, true),
            .wrapsV = joined(patch, Side::VMin, Side::VMax) && goesOn(patch, false),
            .collapsedUMin = collapsed(Side::UMin),
            .collapsedUMax = collapsed(Side::UMax),
            .collapsedVMin = collapsed(Side::VMin),
            .collapsedVMax = collapsed(Side::VMax),
            .orientation = surface_.topology().orientation(patch)};
  }

 private:
  [[nodiscard]] bool joined(std::uint32_t patch, Side lower, Side upper) const {
    const PatchEdge a{patch, lower}, b{patch, upper};
    return std::ranges::any_of(surface_.topology().joints, [&](const Joint& j) {
      return j.smooth && !j.flipped && !j.reversed && ((j.a == a && j.b == b) || (j.a == b && j.b == a));
    });
  }

  /// Whether the surface beyond each end of u (of v) is that at the other end, as far as a search may stray.
  [[nodiscard]] bool goesOn(std::uint32_t patch, bool alongU) const {
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

/// The mesh under the hull, and what stands around each of its points. A point is what vertices of a patch
/// share that are one place of it: at a wrapped seam, at a collapsed edge.
class Frame {
 public:
  struct WallEdge {
    std::uint32_t from = 0, to = 0;  ///< vertices, along the border with the patch at the left
  };

  Frame(const Surface& surface, std::span<const double> parameters, const std::vector<Block>& blocks,
        const std::vector<HullPatch>& patches)
      : mesh_(meshOfBlocks(surface, parameters, blocks, &firstIndices_)), blocks_(blocks) {
    Box box;
    for (const Vec3& p : mesh_.positions) box.add(p);
    size_ = box.empty() ? 0 : glm::length(box.extent());
    numberPoints(patches);
    findFacets();
    findWalls();
    fileByPoint();
  }

  [[nodiscard]] const Mesh& mesh() const { return mesh_; }
  [[nodiscard]] double size() const { return size_; }
  [[nodiscard]] std::size_t pointCount() const { return pointCount_; }
  [[nodiscard]] std::uint32_t pointOf(std::uint32_t vertex) const { return points_[vertex]; }
  [[nodiscard]] std::uint32_t patchOf(std::uint32_t vertex) const { return patches_[vertex]; }
  [[nodiscard]] const std::vector<WallEdge>& walls() const { return walls_; }
  [[nodiscard]] std::size_t blockCount() const { return blocks_.size(); }
  /// Triangles of a block are firstTriangle(b) .. firstTriangle(b + 1) - 1.
  [[nodiscard]] std::size_t firstTriangle(std::size_t block) const { return firstIndices_[block] / 3; }
  [[nodiscard]] const Block& block(std::size_t b) const { return blocks_[b]; }
  /// Unit normal of a triangle; 0 for slivers.
  [[nodiscard]] const Vec3& facet(std::size_t triangle) const { return facets_[triangle]; }

  /// Normals of the triangles around a point, then those of the walls, which lead out of the patch along it.
  [[nodiscard]] std::span<const Vec3> facetsAround(std::uint32_t point) const {
    return std::span(around_).subspan(first_[2 * point], first_[2 * point + 1] - first_[2 * point]);
  }
  [[nodiscard]] std::span<const Vec3> wallsAround(std::uint32_t point) const {
    return std::span(around_).subspan(first_[2 * point + 1], first_[2 * point + 2] - first_[2 * point + 1]);
  }

 private:
  void numberPoints(const std::vector<HullPatch>& patches) {
    patches_.resize(mesh_.positions.size());
    for (std::size_t b = 0; b < blocks_.size(); ++b)
      for (std::size_t i = firstIndices_[b]; i < firstIndices_[b + 1]; ++i)
        patches_[mesh_.indices[i]] = blocks_[b].patch;
    points_.resize(mesh_.positions.size());
    // Vertices of a patch are consecutive.
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> onEdges;
    for (std::uint32_t v = 0; v < points_.size(); ++v) {
      const HullPatch& patch = patches[patches_[v]];
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

  static std::uint64_t hashOf(const Vec2& p) {
    return std::bit_cast<std::uint64_t>(p.x) * 0x9e3779b97f4a7c15u ^ std::bit_cast<std::uint64_t>(p.y);
  }

  static bool onEdge(const Vec2& p, const Domain& d) {
    return p.x == d.u.lo || p.x == d.u.hi || p.y == d.v.lo || p.y == d.v.hi;
  }

  /// One (u, v) for all that are the same place. The ends of collapsed edges are those that collapsed edges
  /// beside them have too.
  static Vec2 canonical(Vec2 p, const HullPatch& patch) {
    const Domain& d = patch.domain;
    if (patch.wrapsU && p.x == d.u.hi) p.x = d.u.lo;
    if (patch.wrapsV && p.y == d.v.hi) p.y = d.v.lo;
    if ((patch.collapsedVMin && p.y == d.v.lo) || (patch.collapsedVMax && p.y == d.v.hi))
      p.x = patch.collapsedUMax ? d.u.hi : d.u.lo;
    if ((patch.collapsedUMin && p.x == d.u.lo) || (patch.collapsedUMax && p.x == d.u.hi)) p.y = d.v.lo;
    return p + 0.0;  // -0 is 0
  }

  [[nodiscard]] std::array<std::uint32_t, 3> corners(std::size_t triangle) const {
    return {mesh_.indices[3 * triangle], mesh_.indices[3 * triangle + 1], mesh_.indices[3 * triangle + 2]};
  }

  void findFacets() {
    facets_.reserve(mesh_.triangleCount());
    for (std::size_t t = 0; t < mesh_.triangleCount(); ++t) {
      const auto [a, b, c] = corners(t);
      const Vec3 ab = mesh_.positions[b] - mesh_.positions[a], ac = mesh_.positions[c] - mesh_.positions[a];
      const double longest = std::max({glm::dot(ab, ab), glm::dot(ac, ac), glm::dot(ac - ab, ac - ab)});
      const Vec3 normal = glm::cross(ab, ac);
      facets_.push_back(glm::length(normal) > kSliver * longest ? unit(normal) : Vec3(0));
    }
  }

  /// Walls stand on edges of triangles that no other triangle of the patch continues.
  void findWalls() {
    const auto key = [&](std::uint32_t a, std::uint32_t b) {
      return (std::uint64_t{points_[a]} << 32) | points_[b];
    };
    std::unordered_map<std::uint64_t, std::uint32_t> open;  // count of directed edges
    open.reserve(mesh_.indices.size());
    const auto forEachEdge = [&](const auto& action) {
      for (std::size_t t = 0; t < mesh_.triangleCount(); ++t)
        for (std::size_t k = 0; k < 3; ++k)
          action(t, mesh_.indices[3 * t + k], mesh_.indices[3 * t + (k + 1) % 3]);
    };
    forEachEdge([&](std::size_t, std::uint32_t a, std::uint32_t b) { ++open[key(a, b)]; });
    forEachEdge([&](std::size_t t, std::uint32_t a, std::uint32_t b) {
      if (open.contains(key(b, a))) return;
      walls_.push_back({a, b});
      const Vec3 out = unit(glm::cross(mesh_.positions[b] - mesh_.positions[a], facets_[t]));
      wallNormals_.push_back(out);
    });
  }

  void fileByPoint() {
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

  std::vector<std::size_t> firstIndices_;  // of blocks; filled while mesh_ is made
  Mesh mesh_;
  const std::vector<Block>& blocks_;
  double size_ = 0;
  std::vector<std::uint32_t> points_, patches_;  // of vertices
  std::size_t pointCount_ = 0;
  std::vector<Vec3> facets_;
  std::vector<WallEdge> walls_;
  std::vector<Vec3> wallNormals_;
  std::vector<std::size_t> first_;  // in around_, of facets and of walls, by point
  std::vector<Vec3> around_;
};

struct Move {
  Vec3 direction{0};
  bool leadsOut = false;
};

/// The shortest vector that goes at least 1 along all facets' normals (times `side`) and all walls' normals:
/// dual coordinate ascent (Hildreth 1957). `leadsOut` is false where there is none, or none short enough.
Move shortestMove(std::span<const Vec3> facets, std::span<const Vec3> walls, double side) {
  constexpr int kSweeps = 100;
  constexpr double kAlmost = 1 - 1e-3;
  const std::size_t count = facets.size() + walls.size();
  if (count == 0) return {};
  const auto normal = [&](std::size_t i) {
    return i < facets.size() ? side * facets[i] : walls[i - facets.size()];
  };
  std::vector<double> weights(count, 0.0);
  Vec3 d(0);
  double least = 0;
  for (int sweep = 0; sweep < kSweeps && least < kAlmost; ++sweep) {
    for (std::size_t i = 0; i < count; ++i) {
      const double change = std::max(-weights[i], 1 - glm::dot(normal(i), d));
      weights[i] += change;
      d += change * normal(i);
    }
    least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < count; ++i) least = std::min(least, glm::dot(normal(i), d));
  }
  const double length = glm::length(d);
  if (least > 0 && length <= kLongestMove * least) return {d / least, true};
  return {kLongestMove * unit(d), false};
}

/// Adds segments to blocks whose triangles turn away too far from the direction in which their corners move.
/// Returns whether it did.
class Refinement {
 public:
  Refinement(const Surface& surface, std::span<const double> parameters, double mostTurn,
             std::vector<Block>& blocks)
      : surface_(surface),
        parameters_(parameters),
        mostTurn_(mostTurn),
        blocks_(blocks),
        worstBefore_(blocks.size(), std::numeric_limits<double>::infinity()) {}

  bool refine(const Frame& frame) {
    std::vector<Vec3> directions(frame.pointCount());
    forEachIndex(directions.size(), directions.size() >= kPointsForAllCores, [&](std::size_t p) {
      directions[p] = unit(shortestMove(frame.facetsAround(static_cast<std::uint32_t>(p)), {}, 1).direction);
    });
    bool refined = false;
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      const double worst = worstTurn(frame, b, directions);
      if (!(worst > mostTurn_) || !(worst < kWorthRefining * worstBefore_[b])) continue;
      worstBefore_[b] = worst;
      refined = raise(frame, b, worst / mostTurn_) || refined;
    }
    return refined;
  }

 private:
  [[nodiscard]] bool atApex(const Block& block, const Vec2& uv) const {
    const Domain& d = surface_.patchDomain(block.patch);
    const auto is = [&](Side side) { return surface_.topology().edge(block.patch, side).kind == Edge::Apex; };
    return (uv.x == d.u.lo && is(Side::UMin)) || (uv.x == d.u.hi && is(Side::UMax)) ||
           (uv.y == d.v.lo && is(Side::VMin)) || (uv.y == d.v.hi && is(Side::VMax));
  }

  /// Largest angle between a triangle's normal and the direction of a corner. What no cells however small
  /// would change does not count.
  [[nodiscard]] double worstTurn(const Frame& frame, std::size_t b,
                                 const std::vector<Vec3>& directions) const {
    const Mesh& mesh = frame.mesh();
    double least = 1;
    for (std::size_t t = frame.firstTriangle(b); t < frame.firstTriangle(b + 1); ++t) {
      if (frame.facet(t) == Vec3(0)) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t v = mesh.indices[3 * t + k];
        if (atApex(blocks_[b], mesh.parameters[v])) continue;
        least = std::min(least, glm::dot(frame.facet(t), directions[frame.pointOf(v)]));
      }
    }
    return std::acos(std::clamp(least, -1.0, 1.0));
  }

  /// Across the directions in which normals turn.
  bool raise(const Frame& frame, std::size_t b, double factor) {
    Block& block = blocks_[b];
    const Vec2 turns = turnsOf(frame, b);
    const double most = std::max(turns.x, turns.y);
    const Segments before = block.segments;
    const auto raised = [&](std::uint32_t segments, double turn) {
      if (!(turn > 0.5 * most)) return segments;
      const double wanted = std::ceil(segments * std::min(factor, 2.0));
      return std::max(segments, static_cast<std::uint32_t>(std::min<double>(wanted, kMostSegments)));
    };
    block.segments = {raised(before.u, turns.x), raised(before.v, turns.y)};
    if (block.segments == before) return false;
    const Domain& domain = surface_.patchDomain(block.patch);
    const Tile& tile = block.tile;
    const Curvature c = curvatureOf(surface_, block.patch, domain, domainOf(tile, domain), parameters_);
    const double bound = c.deviation(tile.widthU() / block.segments.u, tile.widthV() / block.segments.v);
    if (c.proven()) block.bound = std::min(block.bound, bound);
    return true;
  }

  /// Largest angles between vertex normals along edges of triangles that lead along u and along v.
  [[nodiscard]] Vec2 turnsOf(const Frame& frame, std::size_t b) const {
    constexpr double kAlong = 1.5;
    const Mesh& mesh = frame.mesh();
    const Block& block = blocks_[b];
    const Domain cell = domainOf(block.tile, surface_.patchDomain(block.patch));
    const Vec2 extent(cell.u.width() / block.segments.u, cell.v.width() / block.segments.v);
    Vec2 turns(0);
    for (std::size_t t = frame.firstTriangle(b); t < frame.firstTriangle(b + 1); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t i = mesh.indices[3 * t + k], j = mesh.indices[3 * t + (k + 1) % 3];
        const Vec2 step = glm::abs(mesh.parameters[j] - mesh.parameters[i]) / extent;
        const double turn = std::acos(std::clamp(glm::dot(mesh.normals[i], mesh.normals[j]), -1.0, 1.0));
        if (step.x > kAlong * step.y) turns.x = std::max(turns.x, turn);
        if (step.y > kAlong * step.x) turns.y = std::max(turns.y, turn);
      }
    return turns;
  }

  const Surface& surface_;
  std::span<const double> parameters_;
  double mostTurn_;
  std::vector<Block>& blocks_;
  std::vector<double> worstBefore_;
};

/// Turns a frame into a hull.
class Builder {
 public:
  Builder(const Surface& surface, const Frame& frame, const HullDesc& desc)
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
    for (std::size_t b = 0; b < frame_.blockCount(); ++b) {
      const double bound = frame_.block(b).bound;
      const double distance =
          kSlack * (std::isfinite(bound) ? bound : desc_.tolerance) + kRounding * frame_.size();
      for (std::size_t i = 3 * frame_.firstTriangle(b); i < 3 * frame_.firstTriangle(b + 1); ++i) {
        double& largest = distances[frame_.pointOf(mesh_.indices[i])];
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
      const auto point = static_cast<std::uint32_t>(p);
      const std::span<const Vec3> facets = frame_.facetsAround(point), walls = frame_.wallsAround(point);
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
    for (const Frame::WallEdge& wall : frame_.walls()) {
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
  const Frame& frame_;
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
  const PatchReader reader(surface, parameters, box.empty() ? 0 : glm::length(box.extent()));
  for (std::uint32_t patch = 0; patch < surface.patchCount(); ++patch)
    hull.patchData.push_back(reader.read(patch));

  auto frame = std::make_unique<Frame>(surface, parameters, blocks, hull.patchData);
  Refinement refinement(surface, parameters, desc.mostTurn, blocks);
  for (int k = 0; k < kMostRefinements && frame->mesh().triangleCount() < kMostRefinedTriangles; ++k) {
    if (!refinement.refine(*frame)) break;
    frame = std::make_unique<Frame>(surface, parameters, blocks, hull.patchData);
  }
  Builder(surface, *frame, desc).build(hull);
  return hull;
}

}  // namespace luxo
