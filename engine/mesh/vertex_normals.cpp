// SPDX-License-Identifier: Apache-2.0
#include "mesh/vertex_normals.h"

#include <cmath>

#include "math/disjoint_sets.h"
#include "mesh/mesh_topology.h"
#include "mesh/welding.h"

namespace luxo {
namespace {

constexpr Vec3f kNotGiven{0};

// Two roundings to float of each component: off by 1e-7.
Vec3f unitFloat(const Vec3& v) { return Vec3f(unit(v)) + 0.0f; }

class NormalMaker {
 public:
  NormalMaker(const MeshVertices& vertices, std::span<const std::uint32_t> indices,
              std::span<const std::uint32_t> smoothing, double crease)
      : vertices_(vertices), indices_(indices), smoothing_(smoothing), cosCrease_(std::cos(crease)) {}

  [[nodiscard]] std::vector<Vec3f> flat() const {
    std::vector<Vec3f> normals(indices_.size());
    for (std::uint32_t corner = 0; corner < indices_.size(); ++corner)
      normals[corner] = corner % 3 == 0 ? unitFloat(triangleNormal(corner)) : normals[corner - 1];
    return normals;
  }

  // The triangles around a point are one set from crease to crease; their mean is weighed by their angles
  // there (Thuermer, Wuethrich, Computing vertex normals from polygonal facets, 1998).
  [[nodiscard]] std::vector<Vec3f> smooth() const {
    const DisjointSets sets = smoothSets();
    std::vector<std::uint32_t> setOf(indices_.size());
    std::vector<Vec3> sums;
    for (std::uint32_t corner = 0; corner < indices_.size(); ++corner) {
      const std::uint32_t root = sets.find(corner).number;
      if (root == corner) {
        setOf[corner] = std::uint32_t(sums.size());
        sums.emplace_back(0);
      } else {
        setOf[corner] = setOf[root];  // a root is the smallest of its set
      }
      sums[setOf[corner]] += angleAt(corner) * unit(triangleNormal(corner));
    }
    std::vector<Vec3f> normals(indices_.size());
    for (std::uint32_t corner = 0; corner < indices_.size(); ++corner) {
      const Vec3& sum = sums[setOf[corner]];
      normals[corner] =
          unitFloat(glm::dot(sum, sum) > kCancelled * kCancelled ? sum : triangleNormal(corner));
    }
    return normals;
  }

 private:
  static constexpr double kCancelled = 1e-9;  // sums of unit normals this small have no direction

  [[nodiscard]] Vec3 at(std::uint32_t corner) const { return Vec3(vertices_.positions[indices_[corner]]); }
  [[nodiscard]] Vec3 triangleNormal(std::uint32_t corner) const {
    const std::uint32_t first = corner - corner % 3;
    return glm::cross(at(first + 1) - at(first), at(first + 2) - at(first));
  }
  [[nodiscard]] double angleAt(std::uint32_t corner) const {
    const Vec3 a = at(nextCorner(corner)) - at(corner), b = at(previousCorner(corner)) - at(corner);
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
  }
  [[nodiscard]] bool smoothAcross(const EdgeUse& a, const EdgeUse& b) const {
    if (a.forward == b.forward) return false;
    if (!smoothing_.empty()) {
      const std::uint32_t group = smoothing_[a.corner / 3];
      return group != 0 && group == smoothing_[b.corner / 3];
    }
    return glm::dot(unit(triangleNormal(a.corner)), unit(triangleNormal(b.corner))) > cosCrease_;
  }
  [[nodiscard]] DisjointSets smoothSets() const {
    std::vector<std::uint32_t> corners = pointNumbers(vertices_.positions);
    {
      std::vector<std::uint32_t> cornerPoints(indices_.size());
      for (std::size_t i = 0; i < indices_.size(); ++i) cornerPoints[i] = corners[indices_[i]];
      corners = std::move(cornerPoints);
    }
    DisjointSets sets(indices_.size());
    EdgeList(corners, vertices_.positions.size()).forEach([&](std::span<const EdgeUse> uses) {
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

// Corner i is of vertex indices[i] with normal normalOf(i).
template <class NormalOf>
void weld(MeshVertices& vertices, std::vector<std::uint32_t>& indices, NormalOf normalOf, std::size_t records,
          bool corners) {
  const auto vertexOf = [&](std::uint32_t record) { return corners ? indices[record] : record; };
  const bool hasUvs = !vertices.uvs.empty();
  WeldingTable table(
      records,
      [&](std::uint32_t i) {
        std::uint64_t hash = mixed(mixed(0, vertices.positions[vertexOf(i)]), normalOf(i));
        return hasUvs ? mixed(hash, vertices.uvs[vertexOf(i)]) : hash;
      },
      [&](std::uint32_t i, std::uint32_t j) {
        return vertices.positions[vertexOf(i)] == vertices.positions[vertexOf(j)] &&
               normalOf(i) == normalOf(j) &&
               (!hasUvs || vertices.uvs[vertexOf(i)] == vertices.uvs[vertexOf(j)]);
      });
  constexpr std::uint32_t kUnused = 0xffffffff;
  std::vector<std::uint32_t> numberOf(records, kUnused);
  MeshVertices welded;
  for (std::uint32_t i = 0; i < indices.size(); ++i) {
    const std::uint32_t record = corners ? i : indices[i], first = table.firstEqual(record);
    if (numberOf[first] == kUnused) {
      numberOf[first] = std::uint32_t(welded.positions.size());
      welded.positions.push_back(vertices.positions[vertexOf(record)]);
      welded.normals.push_back(normalOf(record));
      if (hasUvs) welded.uvs.push_back(vertices.uvs[vertexOf(record)]);
    }
    numberOf[record] = numberOf[first];
  }
  for (std::uint32_t i = 0; i < indices.size(); ++i) indices[i] = numberOf[corners ? i : indices[i]];
  vertices = std::move(welded);
}

}  // namespace

void giveNormals(MeshVertices& vertices, std::vector<std::uint32_t>& indices,
                 std::span<const std::uint32_t> smoothing, const MeshOptions& options) {
  const bool given = options.normals == NormalRule::Given && !vertices.normals.empty();
  if (given)
    for (Vec3f& normal : vertices.normals) normal = unitFloat(Vec3(normal));
  bool complete = given;
  for (std::size_t i = 0; complete && i < indices.size(); ++i)
    complete = vertices.normals[indices[i]] != kNotGiven;
  if (complete) {
    const std::vector<Vec3f> normals = std::move(vertices.normals);
    weld(
        vertices, indices, [&](std::uint32_t vertex) { return normals[vertex]; }, normals.size(), false);
    return;
  }
  const NormalMaker maker(vertices, indices, smoothing, options.crease);
  std::vector<Vec3f> normals = options.normals == NormalRule::Flat ? maker.flat() : maker.smooth();
  if (given)
    for (std::size_t i = 0; i < indices.size(); ++i)
      if (vertices.normals[indices[i]] != kNotGiven) normals[i] = vertices.normals[indices[i]];
  weld(
      vertices, indices, [&](std::uint32_t corner) { return normals[corner]; }, normals.size(), true);
}

}  // namespace luxo
