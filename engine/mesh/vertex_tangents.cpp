// SPDX-License-Identifier: Apache-2.0
#include "mesh/vertex_tangents.h"

#include <cmath>

#include "math/disjoint_sets.h"
#include "mesh/mesh_topology.h"

namespace luxo {
namespace {

constexpr std::uint32_t kNoCorner = 0xffffffff;

/// Where u grows on a triangle.
struct Direction {
  Vec3 u{0};
  int sign = 0;  ///< 1: its uvs turn as it does, -1: mirrored, 0: they have no area
};

class TangentMaker {
 public:
  TangentMaker(const MeshVertices& vertices, const std::vector<std::uint32_t>& indices)
      : vertices_(vertices), indices_(indices) {}

  [[nodiscard]] Vec3 at(std::uint32_t corner) const { return Vec3(vertices_.positions[indices_[corner]]); }
  [[nodiscard]] Vec3 normalAt(std::uint32_t corner) const {
    return unit(Vec3(vertices_.normals[indices_[corner]]));
  }

  [[nodiscard]] Direction direction(std::uint32_t corner) const {
    const std::uint32_t first = corner - corner % 3;
    const auto uv = [&](std::uint32_t i) {
      const Vec2f given = vertices_.uvs[indices_[first + i]];
      return Vec2(given.x, -double(given.y));
    };
    const Vec2 a = uv(1) - uv(0), b = uv(2) - uv(0);
    const double area = a.x * b.y - a.y * b.x;
    if (area == 0 || !std::isfinite(area)) return {};
    const double sign = area > 0 ? 1 : -1;
    return {unit(sign * (b.y * (at(first + 1) - at(first)) - a.y * (at(first + 2) - at(first)))), int(sign)};
  }

  [[nodiscard]] Vec3 weighed(std::uint32_t corner) const {
    const Vec3 normal = normalAt(corner);
    const auto inPlane = [&](const Vec3& v) { return unit(v - glm::dot(normal, v) * normal); };
    const double cosine = glm::dot(inPlane(at(nextCorner(corner)) - at(corner)),
                                   inPlane(at(previousCorner(corner)) - at(corner)));
    return std::acos(std::min(1.0, std::max(-1.0, cosine))) * inPlane(direction(corner).u);
  }

  // Corners of one vertex whose triangles hang together there, mirrored alike.
  [[nodiscard]] DisjointSets sets() const {
    DisjointSets sets(indices_.size());
    EdgeList(indices_, vertices_.positions.size()).forEach([&](std::span<const EdgeUse> uses) {
      if (uses.size() != 2 || uses[0].forward == uses[1].forward) return;
      const int a = direction(uses[0].corner).sign, b = direction(uses[1].corner).sign;
      if (a == 0 || a != b) return;
      sets.unite(uses[0].corner, nextCorner(uses[1].corner));
      sets.unite(nextCorner(uses[0].corner), uses[1].corner);
    });
    return sets;
  }

 private:
  const MeshVertices& vertices_;
  const std::vector<std::uint32_t>& indices_;
};

// Perpendicular to the normal, once more after rounding to float.
Vec4f tangentOf(const Vec3& sum, const Vec3& normal, int sign) {
  Vec3 direction = unit(sum - glm::dot(sum, normal) * normal);
  if (direction == Vec3(0))
    direction = unit(glm::cross(normal, std::abs(normal.x) < 0.5 ? Vec3(1, 0, 0) : Vec3(0, 1, 0)));
  return {Vec3f(direction) + 0.0f, sign < 0 ? -1.0f : 1.0f};
}

}  // namespace

std::vector<Vec4f> giveTangents(MeshVertices& vertices, std::vector<std::uint32_t>& indices) {
  const TangentMaker maker(vertices, indices);
  const DisjointSets sets = maker.sets();
  std::vector<std::uint32_t> numberOf(indices.size(), kNoCorner);  // of each corner's set, at its root first
  std::vector<std::uint32_t> mapped(vertices.positions.size(),
                                    kNoCorner);  // a corner there whose uvs have an area
  for (std::uint32_t corner = 0; corner < indices.size(); ++corner)
    if (mapped[indices[corner]] == kNoCorner && maker.direction(corner).sign != 0)
      mapped[indices[corner]] = corner;

  std::vector<Vec3> sums;
  std::vector<std::uint32_t> corners;  // the first of each new vertex
  for (std::uint32_t corner = 0; corner < indices.size(); ++corner) {
    const bool unmapped = maker.direction(corner).sign == 0;
    // What has no uvs to speak of takes the tangent of its neighbours.
    const std::uint32_t like = !unmapped                              ? corner
                               : mapped[indices[corner]] != kNoCorner ? mapped[indices[corner]]
                                                                      : corner;
    const std::uint32_t root = sets.find(like).number;
    if (numberOf[root] == kNoCorner) {
      numberOf[root] = std::uint32_t(sums.size());
      sums.emplace_back(0);
      corners.push_back(like);
    }
    numberOf[corner] = numberOf[root];
    if (!unmapped) sums[numberOf[corner]] += maker.weighed(corner);
  }

  MeshVertices split;
  std::vector<Vec4f> tangents;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const std::uint32_t vertex = indices[corners[i]];
    split.positions.push_back(vertices.positions[vertex]);
    split.normals.push_back(vertices.normals[vertex]);
    split.uvs.push_back(vertices.uvs[vertex]);
    if (!vertices.rest.empty()) {
      split.rest.push_back(vertices.rest[vertex]);
      split.restNormals.push_back(vertices.restNormals[vertex]);
    }
    tangents.push_back(tangentOf(sums[i], maker.normalAt(corners[i]), maker.direction(corners[i]).sign));
  }
  vertices = std::move(split);
  indices = std::move(numberOf);
  return tangents;
}

}  // namespace luxo
