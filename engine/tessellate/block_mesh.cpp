// SPDX-License-Identifier: Apache-2.0
#include "tessellate/block_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "math/disjoint_sets.h"
#include "tessellate/edge_net.h"
#include "tessellate/parallel.h"

namespace luxo {
namespace {

/// Parts of sides are rounded, so that cells may be larger than planned by 1e-10 of themselves.
constexpr double kRoundingSlack = 1 + 1e-9;

/// So few vertices are not worth waking a thread.
constexpr std::size_t kVerticesPerTask = 8192;

bool finite(const Vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

/// Fills positions, normals and parameters.
class Evaluator {
 public:
  Evaluator(const Surface& surface, std::span<const double> parameters, Mesh& mesh)
      : surface_(surface), parameters_(parameters), mesh_(mesh) {}

  void set(std::uint32_t patch, std::size_t vertex, const SurfacePoints& points, std::size_t k,
           const Vec2& uv) {
    const Vec3 cross = glm::cross(points.du[k], points.dv[k]);
    // A vanishing cross product (written so that NaN counts too) has a limit that the surface knows how to
    // find.
    const bool regular = glm::length(cross) > 1e-9 * glm::length(points.du[k]) * glm::length(points.dv[k]);
    mesh_.positions[vertex] = points.position[k];
    mesh_.parameters[vertex] = uv;
    if (regular)
      mesh_.normals[vertex] = surface_.topology().orientation(patch) * unit(cross);
    else if (finite(points.position[k]))
      mesh_.normals[vertex] = surface_.normal(patch, uv.x, uv.y, parameters_);
  }

  /// The vertices of one patch among those on edges.
  void edges(std::uint32_t patch, std::span<const EdgeVertex> vertices,
             std::span<const std::uint32_t> numbers) {
    const Domain& domain = surface_.patchDomain(patch);
    std::vector<double> u, v;
    for (const std::uint32_t n : numbers) {
      u.push_back(parameterAt(domain.u, vertices[n].partU));
      v.push_back(parameterAt(domain.v, vertices[n].partV));
    }
    const SurfacePoints points = surface_.evaluate(patch, u, v, parameters_);
    for (std::size_t k = 0; k < numbers.size(); ++k) set(patch, numbers[k], points, k, {u[k], v[k]});
  }

  /// Rows firstRow .. rowEnd - 1 of the inner vertices of a block, those of row 1 starting at `first`.
  void interior(const Block& block, std::size_t first, std::uint32_t firstRow, std::uint32_t rowEnd) {
    const Domain cell = domainOf(block.tile, surface_.patchDomain(block.patch));
    std::vector<double> us, vs;
    for (std::uint32_t i = 1; i < block.segments.u; ++i)
      us.push_back(parameterAt(cell.u, static_cast<double>(i) / block.segments.u));
    for (std::uint32_t j = firstRow; j < rowEnd; ++j)
      vs.push_back(parameterAt(cell.v, static_cast<double>(j) / block.segments.v));
    const SurfacePoints points = surface_.evaluateGrid(block.patch, us, vs, parameters_);
    std::size_t vertex = first + (firstRow - 1) * us.size(), k = 0;
    for (const double v : vs)
      for (const double u : us) set(block.patch, vertex++, points, k++, {u, v});
  }

 private:
  const Surface& surface_;
  std::span<const double> parameters_;
  Mesh& mesh_;
};

/// Turns blocks into triangles of vertices that have their places.
class Triangulator {
 public:
  Triangulator(const Surface& surface, std::span<const double> parameters, const std::vector<Block>& blocks,
               const EdgeNet& net, const DisjointSets& points, Mesh& mesh)
      : surface_(surface), parameters_(parameters), blocks_(blocks), net_(net), points_(points), mesh_(mesh) {
    collapsedAlong_.resize(net.vertices().size(), Collapsed::No);
    for (std::size_t b = 0; b < blocks.size(); ++b)
      for (const Side side : kSides) markCollapsed(b, side);
  }

  /// `firstInner` is the number of the block's first inner vertex.
  void add(std::size_t b, std::size_t firstInner) {
    block_ = &blocks_[b];
    number_ = b;
    firstInner_ = firstInner;
    const auto [nu, nv] = block_->segments;
    const bool left = net_.plain(b, Side::UMin), right = net_.plain(b, Side::UMax);
    const bool bottom = net_.plain(b, Side::VMin), top = net_.plain(b, Side::VMax);
    const std::uint32_t firstColumn = left ? 0 : 1, columnEnd = right ? nu : nu - 1;
    const std::uint32_t firstRow = bottom ? 0 : 1, rowEnd = top ? nv : nv - 1;
    addCells(firstColumn, columnEnd, firstRow, rowEnd);
    if (!bottom) addStrip(Side::VMin, firstColumn, columnEnd, firstRow);
    if (!right) addStrip(Side::UMax, firstRow, rowEnd, columnEnd);
    if (!top) addStrip(Side::VMax, firstColumn, columnEnd, rowEnd);
    if (!left) addStrip(Side::UMin, firstRow, rowEnd, firstColumn);
  }

 private:
  enum class Collapsed : std::uint8_t { No, AlongU, AlongV };

  void markCollapsed(std::size_t b, Side side) {
    const Tile& t = blocks_[b].tile;
    const bool onEdge = side == Side::UMin   ? t.lowU() == 0
                        : side == Side::UMax ? t.highU() == 1
                        : side == Side::VMin ? t.lowV() == 0
                                             : t.highV() == 1;
    if (!onEdge || !surface_.topology().edge(blocks_[b].patch, side).collapsed()) return;
    const bool alongV = side == Side::UMin || side == Side::UMax;
    for (const std::uint32_t v : net_.side(b, side))
      collapsedAlong_[v] = alongV ? Collapsed::AlongV : Collapsed::AlongU;
  }

  /// The vertex at column i, row j of the block's cells; on a side only if that is plain.
  [[nodiscard]] std::uint32_t vertex(std::uint32_t i, std::uint32_t j) const {
    const auto [nu, nv] = block_->segments;
    const bool inside = i > 0 && i < nu && j > 0 && j < nv;
    if (inside) return static_cast<std::uint32_t>(firstInner_ + std::size_t{j - 1} * (nu - 1) + (i - 1));
    if (j == 0 && net_.plain(number_, Side::VMin)) return net_.side(number_, Side::VMin)[i];
    if (j == nv && net_.plain(number_, Side::VMax)) return net_.side(number_, Side::VMax)[i];
    return net_.side(number_, i == 0 ? Side::UMin : Side::UMax)[j];
  }

  void addCells(std::uint32_t firstColumn, std::uint32_t columnEnd, std::uint32_t firstRow,
                std::uint32_t rowEnd) {
    // In bands so narrow that a row's vertices are still in a GPU's cache when the next row needs them.
    constexpr std::uint32_t kBand = 14;
    for (std::uint32_t start = firstColumn; start < columnEnd; start += kBand)
      for (std::uint32_t j = firstRow; j < rowEnd; ++j)
        for (std::uint32_t i = start; i < std::min(columnEnd, start + kBand); ++i) {
          const std::uint32_t a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1),
                              d = vertex(i, j + 1);
          addTriangle(a, b, c);
          addTriangle(a, c, d);
        }
  }

  /// Fills the ring between a side's vertices o_0 .. o_m and the line of the block's own vertices next to it,
  /// q_first .. q_last, which starts and ends at most one cell later and earlier. Both advance in turn: next
  /// comes the segment with the nearer middle. So the middle of a segment o_i o_i+1 that gets q_k as its
  /// third corner lies between the middles of q_k-1 q_k and q_k q_k+1, which is within half a cell of q_k; as
  /// the segment itself reaches half a cell from its middle, no triangle is longer than one cell. Beyond the
  /// first and the last q there is at most one cell.
  void addStrip(Side side, std::uint32_t first, std::uint32_t last, std::uint32_t line) {
    const bool alongV = side == Side::UMin || side == Side::UMax;
    const bool insideIsLeft = side == Side::VMin || side == Side::UMax;  // of the direction of advance
    const std::span<const std::uint32_t> outer = net_.side(number_, side);
    const Tile& t = block_->tile;
    const double low = alongV ? t.lowV() : t.lowU(), width = alongV ? t.widthV() : t.widthU();
    const std::uint32_t cells = alongV ? block_->segments.v : block_->segments.u;
    const auto outerPart = [&](std::size_t i) {
      const EdgeVertex& v = net_.vertices()[outer[i]];
      return alongV ? v.partV : v.partU;
    };
    const auto innerPart = [&](std::uint32_t k) { return low + width * (static_cast<double>(k) / cells); };
    const auto inner = [&](std::uint32_t k) { return alongV ? vertex(line, k) : vertex(k, line); };
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      insideIsLeft ? addTriangle(a, b, c) : addTriangle(b, a, c);
    };
    std::size_t i = 0;
    std::uint32_t k = first;
    while (i + 1 < outer.size() || k < last) {
      const bool outerNext = k == last || (i + 1 < outer.size() && outerPart(i) + outerPart(i + 1) <=
                                                                       innerPart(k) + innerPart(k + 1));
      if (outerNext) {
        add(outer[i], outer[i + 1], inner(k));
        ++i;
      } else {
        add(inner(k + 1), inner(k), outer[i]);
        ++k;
      }
    }
  }

  [[nodiscard]] Collapsed collapsedAlong(std::uint32_t v) const {
    return v < collapsedAlong_.size() ? collapsedAlong_[v] : Collapsed::No;
  }

  /// Counter-clockwise in (u,v).
  void addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    std::array<std::uint32_t, 3> corners{a, b, c};
    for (std::size_t k = 0; k < 3; ++k)
      if (collapsedAlong(corners[k]) != Collapsed::No) {
        if (!replaceCollapsed(corners, k)) return;
        break;
      }
    for (const std::uint32_t corner : corners)
      if (!finite(mesh_.positions[corner])) {
        ++mesh_.dropped;
        return;
      }
    if (surface_.topology().orientation(block_->patch) < 0) std::swap(corners[1], corners[2]);
    mesh_.indices.insert(mesh_.indices.end(), corners.begin(), corners.end());
  }

  /// Where an edge is one point, every triangle that ends there has a vertex of its own, in the middle of
  /// what it spans. Returns false for a triangle without area, two of whose corners are that point.
  bool replaceCollapsed(std::array<std::uint32_t, 3>& corners, std::size_t k) {
    const std::uint32_t at = corners[k], next = corners[(k + 1) % 3], last = corners[(k + 2) % 3];
    const std::uint32_t point = points_.find(at).number;
    for (const std::uint32_t other : {next, last})
      if (collapsedAlong(other) != Collapsed::No && points_.find(other).number == point) return false;
    Vec2 uv = mesh_.parameters[at];
    const Vec2 middle = 0.5 * (mesh_.parameters[next] + mesh_.parameters[last]);
    (collapsedAlong(at) == Collapsed::AlongU ? uv.x : uv.y) =
        collapsedAlong(at) == Collapsed::AlongU ? middle.x : middle.y;
    corners[k] = static_cast<std::uint32_t>(mesh_.positions.size());
    const Vec3 position = mesh_.positions[at];
    mesh_.positions.push_back(position);
    mesh_.normals.push_back(surface_.normal(block_->patch, uv.x, uv.y, parameters_));
    mesh_.parameters.push_back(uv);
    return true;
  }

  const Surface& surface_;
  std::span<const double> parameters_;
  const std::vector<Block>& blocks_;
  const EdgeNet& net_;
  const DisjointSets& points_;
  Mesh& mesh_;
  std::vector<Collapsed> collapsedAlong_;
  const Block* block_ = nullptr;
  std::size_t number_ = 0, firstInner_ = 0;
};

/// Keeps the vertices that triangles use, in the order of first use.
void compact(Mesh& mesh) {
  constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> numbers(mesh.positions.size(), kUnused);
  std::vector<std::uint32_t> used;
  used.reserve(numbers.size());
  for (std::uint32_t& index : mesh.indices) {
    std::uint32_t& number = numbers[index];
    if (number == kUnused) {
      number = static_cast<std::uint32_t>(used.size());
      used.push_back(index);
    }
    index = number;
  }
  const auto pick = [&](auto& values) {
    std::remove_reference_t<decltype(values)> picked;
    picked.reserve(used.size());
    for (const std::uint32_t i : used) picked.push_back(values[i]);
    values = std::move(picked);
  };
  pick(mesh.positions);
  pick(mesh.normals);
  pick(mesh.parameters);
}

/// Evaluates all vertices: those on edges first, then the inner ones of each block from its number on.
void evaluateAll(const Surface& surface, std::span<const double> parameters, const std::vector<Block>& blocks,
                 const EdgeNet& net, const std::vector<std::size_t>& firstInner, Mesh& mesh) {
  Evaluator evaluator(surface, parameters, mesh);
  std::vector<std::vector<std::uint32_t>> edgesOfPatch(surface.patchCount());
  for (std::uint32_t v = 0; v < net.vertices().size(); ++v)
    edgesOfPatch[net.vertices()[v].patch].push_back(v);
  struct Task {
    std::size_t block = 0;
    std::uint32_t firstRow = 0, rowEnd = 0;
  };
  std::vector<Task> tasks;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const auto [nu, nv] = blocks[b].segments;
    if (nu < 2) continue;
    const auto rows = static_cast<std::uint32_t>(std::max<std::size_t>(1, kVerticesPerTask / nu));
    for (std::uint32_t row = 1; row < nv; row += rows) tasks.push_back({b, row, std::min(nv, row + rows)});
  }
  const bool many = mesh.positions.size() >= 2 * kVerticesPerTask;
  forEachIndex(edgesOfPatch.size() + tasks.size(), many, [&](std::size_t i) {
    if (i < edgesOfPatch.size()) {
      evaluator.edges(static_cast<std::uint32_t>(i), net.vertices(), edgesOfPatch[i]);
      return;
    }
    const Task& task = tasks[i - edgesOfPatch.size()];
    evaluator.interior(blocks[task.block], firstInner[task.block], task.firstRow, task.rowEnd);
  });
}

/// Gives twins the same bits. Returns how far that moves a vertex.
double joinTwins(const EdgeNet& net, const DisjointSets& points, Mesh& mesh) {
  DisjointSets normals(net.vertices().size());
  for (const Twin& twin : net.twins())
    if (twin.sameNormal) normals.unite(twin.a, twin.b, twin.flipped);
  double moved = 0;
  for (std::uint32_t v = 0; v < net.vertices().size(); ++v) {
    const Vec3 position = mesh.positions[points.find(v).number];
    const double distance = glm::length(position - mesh.positions[v]);
    if (distance > 0) moved = std::max(moved, distance);
    mesh.positions[v] = position;
    const auto [first, flipped] = normals.find(v);
    if (first != v) mesh.normals[v] = flipped ? -mesh.normals[first] : mesh.normals[first];
  }
  return moved;
}

Vec3 originOf(const std::vector<Vec3>& positions) {
  Box box;
  for (const Vec3& p : positions)
    if (finite(p)) box.add(p);
  if (box.empty()) return Vec3(0);
  const Vec3 center = 0.5 * (box.min + box.max);
  return glm::length(center) > glm::length(box.extent()) ? center : Vec3(0);
}

}  // namespace

Mesh meshOfBlocks(const Surface& surface, std::span<const double> parameters, std::vector<Block> blocks,
                  std::vector<std::size_t>* firstIndices) {
  const EdgeNet net(surface.topology(), blocks);
  std::size_t vertices = net.vertices().size(), triangles = 0;
  std::vector<std::size_t> firstInner;
  for (const Block& block : blocks) {
    firstInner.push_back(vertices);
    vertices += std::size_t{block.segments.u - 1} * (block.segments.v - 1);
    triangles += std::size_t{2} * block.segments.u * block.segments.v;
  }
  Mesh mesh;
  mesh.positions.resize(vertices, Vec3(0));
  mesh.normals.resize(vertices, Vec3(0, 1, 0));
  mesh.parameters.resize(vertices, Vec2(0));
  mesh.indices.reserve(3 * (triangles + net.vertices().size()));
  evaluateAll(surface, parameters, blocks, net, firstInner, mesh);

  DisjointSets points(net.vertices().size());
  for (const Twin& twin : net.twins()) points.unite(twin.a, twin.b);
  const double moved = joinTwins(net, points, mesh);
  for (const Block& block : blocks) mesh.bound = std::max(mesh.bound, block.bound);
  mesh.bound = mesh.bound * kRoundingSlack + moved;

  Triangulator triangulator(surface, parameters, blocks, net, points, mesh);
  if (firstIndices) firstIndices->assign(1, 0);
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    triangulator.add(b, firstInner[b]);
    if (firstIndices) firstIndices->push_back(mesh.indices.size());
  }
  // Derivatives may be known where the formula has no value: log(-1) + u is straight.
  if (mesh.dropped > 0) mesh.bound = std::numeric_limits<double>::infinity();
  compact(mesh);
  mesh.origin = originOf(mesh.positions);
  return mesh;
}

}  // namespace luxo
