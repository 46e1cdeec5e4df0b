// SPDX-License-Identifier: Apache-2.0
#include "mesh/vertex_normals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "math/disjoint_sets.h"
#include "mesh/welding.h"

namespace luxo {
namespace {

constexpr Vec3f kNotGiven{0};

// Two roundings to float of each component: off by 1e-7.
Vec3f unitFloat(const Vec3& v) { return Vec3f(unit(v)) + 0.0f; }

/// Normals by their numbers, of which every corner has one.
struct CornerNormals {
  std::vector<std::uint32_t> numbers;
  std::vector<Vec3f> normals;
};

class NormalMaker {
 public:
  NormalMaker(const MeshVertices& vertices, std::span<const std::uint32_t> indices,
              std::span<const std::uint32_t> smoothing, double crease)
      : vertices_(vertices), indices_(indices), smoothing_(smoothing), cosCrease_(std::cos(crease)) {}

  [[nodiscard]] CornerNormals flat() const {
    CornerNormals flat{.numbers = std::vector<std::uint32_t>(indices_.size())};
    flat.normals.reserve(indices_.size() / 3);
    for (std::uint32_t corner = 0; corner < indices_.size(); ++corner) {
      if (corner % 3 == 0) flat.normals.push_back(unitFloat(triangleNormal(corner)));
      flat.numbers[corner] = corner / 3;
    }
    return flat;
  }

  // The triangles around a point are one set from crease to crease; their mean is weighed by their angles
  // there (Thuermer, Wuethrich, Computing vertex normals from polygonal facets, 1998).
  [[nodiscard]] CornerNormals smooth(EdgeList edges) const {
    CornerNormals smooth;
    std::uint32_t count = 0;
    {
      const DisjointSets sets = smoothSets(std::move(edges));
      smooth.numbers.resize(indices_.size());
      for (std::uint32_t corner = 0; corner < indices_.size(); ++corner) {
        const std::uint32_t root = sets.find(corner).number;  // the smallest of its set
        smooth.numbers[corner] = root == corner ? count++ : smooth.numbers[root];
      }
    }
    std::vector<Vec3> sums(count, Vec3(0));
    for (std::uint32_t first = 0; first < indices_.size(); first += 3) {
      const Vec3 normal = unit(triangleNormal(first));
      const std::array<double, 3> angles = anglesOf(first);
      for (std::uint32_t i = 0; i < 3; ++i) sums[smooth.numbers[first + i]] += angles[i] * normal;
    }
    smooth.normals.reserve(count);
    for (std::uint32_t corner = 0; smooth.normals.size() < count; ++corner) {
      if (smooth.numbers[corner] != smooth.normals.size()) continue;  // not the first of its set
      const Vec3& sum = sums[smooth.normals.size()];
      smooth.normals.push_back(
          unitFloat(glm::dot(sum, sum) > kCancelled * kCancelled ? sum : triangleNormal(corner)));
    }
    return smooth;
  }

 private:
  static constexpr double kCancelled = 1e-9;  // sums of unit normals this small have no direction

  [[nodiscard]] Vec3 at(std::uint32_t corner) const { return Vec3(vertices_.positions[indices_[corner]]); }
  [[nodiscard]] Vec3 triangleNormal(std::uint32_t corner) const {
    const std::uint32_t first = corner - corner % 3;
    return glm::cross(at(first + 1) - at(first), at(first + 2) - at(first));
  }
  // They are half a turn together.
  [[nodiscard]] std::array<double, 3> anglesOf(std::uint32_t first) const {
    const Vec3 a = at(first + 1) - at(first), b = at(first + 2) - at(first), c = b - a;
    const double area = glm::length(glm::cross(a, b));
    const double atFirst = std::atan2(area, glm::dot(a, b)), atSecond = std::atan2(area, -glm::dot(a, c));
    return {atFirst, atSecond, std::max(0.0, kPi - atFirst - atSecond)};
  }
  [[nodiscard]] bool smoothAcross(const EdgeUse& a, const EdgeUse& b) const {
    if (a.forward == b.forward) return false;
    if (!smoothing_.empty()) {
      const std::uint32_t group = smoothing_[a.corner / 3];
      return group != 0 && group == smoothing_[b.corner / 3];
    }
    return glm::dot(unit(triangleNormal(a.corner)), unit(triangleNormal(b.corner))) > cosCrease_;
  }
  [[nodiscard]] DisjointSets smoothSets(EdgeList edges) const {
    DisjointSets sets(indices_.size());
    edges.forEach([&](std::span<const EdgeUse> uses) {
      if (uses.size() != 2 || !smoothAcross(uses[0], uses[1])) return;
      sets.unite(uses[0].corner, nextCorner(uses[1].corner));
      sets.unite(nextCorner(uses[0].corner), uses[1].corner);
    });
    return sets;
  }

  const MeshVertices& vertices_;
  std::span<const std::uint32_t> indices_;
  std::span<const std::uint32_t> smoothing_;
  double cosCrease_;
};

/// By the numbers of what it is made of: a vertex that is given, and a normal.
struct WeldedVertex {
  std::uint32_t given = 0, normal = 0;
};

/// Vertices that differ, as they come.
class WeldedVertices {
 public:
  WeldedVertices(const MeshVertices& given, const std::vector<Vec3f>& normals)
      : given_(given), normals_(normals) {}

  /// Of a vertex that is given, with that normal.
  std::uint32_t numberOf(std::uint32_t vertex, std::uint32_t normal) {
    const auto last = std::uint32_t(vertices_.size());
    vertices_.push_back({vertex, normal});
    const std::uint32_t number = table_.firstEqual(last);
    if (number != last) vertices_.pop_back();
    return number;
  }
  [[nodiscard]] std::vector<WeldedVertex> take() { return std::move(vertices_); }

 private:
  struct Hash {
    const WeldedVertices& welded;
    std::uint64_t operator()(std::uint32_t i) const {
      const MeshVertices& given = welded.given_;
      const auto [vertex, normal] = welded.vertices_[i];
      std::uint64_t hash = mixed(mixed(0, given.positions[vertex]), welded.normals_[normal]);
      if (!given.rest.empty()) hash = mixed(mixed(hash, given.rest[vertex]), given.restNormals[vertex]);
      return given.uvs.empty() ? hash : mixed(hash, given.uvs[vertex]);
    }
  };
  struct Equal {
    const WeldedVertices& welded;
    bool operator()(std::uint32_t i, std::uint32_t j) const {
      const MeshVertices& given = welded.given_;
      const auto [a, normalA] = welded.vertices_[i];
      const auto [b, normalB] = welded.vertices_[j];
      return given.positions[a] == given.positions[b] &&
             welded.normals_[normalA] == welded.normals_[normalB] &&
             (given.uvs.empty() || given.uvs[a] == given.uvs[b]) &&
             (given.rest.empty() ||
              (given.rest[a] == given.rest[b] && given.restNormals[a] == given.restNormals[b]));
    }
  };

  const MeshVertices& given_;
  const std::vector<Vec3f>& normals_;
  std::vector<WeldedVertex> vertices_;
  WeldingTable<Hash, Equal> table_{Hash{*this}, Equal{*this}};
};

std::vector<std::uint32_t> weld(MeshVertices& vertices, std::vector<std::uint32_t>& indices,
                                CornerNormals corners) {
  constexpr std::uint32_t kNone = 0xffffffff;
  std::vector<WeldedVertex> distinct;
  {
    const std::vector<std::uint32_t> numbers = std::move(corners.numbers);
    WeldedVertices welded(vertices, corners.normals);
    // Corners that share a normal mostly share a vertex, too: then there is nothing to search for.
    struct Vertex {
      std::uint32_t given = kNone, welded = kNone;
    };
    std::vector<Vertex> lastOf(corners.normals.size());
    for (std::size_t i = 0; i < indices.size(); ++i) {
      Vertex& last = lastOf[numbers[i]];
      if (last.given != indices[i]) last = {indices[i], welded.numberOf(indices[i], numbers[i])};
      indices[i] = last.welded;
    }
    distinct = welded.take();
  }
  std::vector<std::uint32_t> vertexOf, normalOf;
  vertexOf.reserve(distinct.size());
  normalOf.reserve(distinct.size());
  for (const auto& [vertex, normal] : distinct) {
    vertexOf.push_back(vertex);
    normalOf.push_back(normal);
  }
  distinct = std::vector<WeldedVertex>();
  vertices.normals = std::move(corners.normals);
  vertices.positions = reordered(vertices.positions, vertexOf);
  vertices.uvs = reordered(vertices.uvs, vertexOf);
  vertices.rest = reordered(vertices.rest, vertexOf);
  vertices.restNormals = reordered(vertices.restNormals, vertexOf);
  return normalOf;
}

}  // namespace

std::vector<std::uint32_t> giveNormals(MeshVertices& vertices, std::vector<std::uint32_t>& indices,
                                       EdgeList edges, std::span<const std::uint32_t> smoothing,
                                       const MeshOptions& options) {
  const bool given = options.normals == NormalRule::Given && !vertices.normals.empty();
  if (given)
    for (Vec3f& normal : vertices.normals) normal = unitFloat(Vec3(normal));
  const auto isGiven = [&](std::uint32_t vertex) { return given && vertices.normals[vertex] != kNotGiven; };
  CornerNormals corners;
  if (std::all_of(indices.begin(), indices.end(), isGiven)) {
    edges = {};
    corners = {.numbers = indices, .normals = std::move(vertices.normals)};
  } else {
    const NormalMaker maker(vertices, indices, smoothing, options.crease);
    if (options.normals == NormalRule::Flat) {
      edges = {};
      corners = maker.flat();
    } else {
      corners = maker.smooth(std::move(edges));
    }
    for (std::size_t i = 0; i < indices.size(); ++i)
      if (isGiven(indices[i])) {
        corners.numbers[i] = std::uint32_t(corners.normals.size());
        corners.normals.push_back(vertices.normals[indices[i]]);
      }
  }
  return weld(vertices, indices, std::move(corners));
}

}  // namespace luxo
