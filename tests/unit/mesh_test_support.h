// SPDX-License-Identifier: Apache-2.0
// Meshes and checks that the tests of engine/mesh share.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <vector>

#include "mesh/index_windows.h"
#include "mesh/triangle_mesh.h"

namespace luxo {

/// A sphere of radius 1 around `center`: rings of latitude, one vertex a point, poles included. Closed;
/// without normals; 2 * around * (rings - 1) triangles.
inline MeshArrays ballArrays(std::uint32_t around, std::uint32_t rings, const Vec3& center = Vec3(0)) {
  MeshArrays arrays;
  arrays.positions.push_back(center + Vec3(0, 1, 0));
  for (std::uint32_t ring = 1; ring < rings; ++ring)
    for (std::uint32_t i = 0; i < around; ++i) {
      const double theta = kPi * ring / rings, phi = kTau * i / around;
      arrays.positions.push_back(
          center + Vec3(std::sin(theta) * std::cos(phi), std::cos(theta), -std::sin(theta) * std::sin(phi)));
    }
  arrays.positions.push_back(center + Vec3(0, -1, 0));
  const auto at = [&](std::uint32_t ring, std::uint32_t i) {
    if (ring == 0) return 0u;
    return ring == rings ? std::uint32_t(arrays.positions.size() - 1) : 1 + (ring - 1) * around + i % around;
  };
  for (std::uint32_t ring = 0; ring < rings; ++ring)
    for (std::uint32_t i = 0; i < around; ++i) {
      const std::uint32_t a = at(ring, i), b = at(ring + 1, i), c = at(ring + 1, i + 1), d = at(ring, i + 1);
      if (ring + 1 < rings) arrays.indices.insert(arrays.indices.end(), {a, b, c});
      if (ring > 0) arrays.indices.insert(arrays.indices.end(), {a, c, d});
    }
  return arrays;
}

/// The cube from -1 to 1, eight vertices, twelve triangles.
inline MeshArrays cubeArrays() {
  MeshArrays arrays;
  for (int i = 0; i < 8; ++i) arrays.positions.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
  arrays.indices = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                    2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  return arrays;
}

using TriangleKey = std::array<std::array<float, 3>, 3>;

/// A triangle by the bits of its points, from its smallest on: the same however it is numbered.
inline TriangleKey keyOf(const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  TriangleKey key{{{a.x, a.y, a.z}, {b.x, b.y, b.z}, {c.x, c.y, c.z}}};
  std::rotate(key.begin(), std::min_element(key.begin(), key.end()), key.end());
  return key;
}

inline std::map<TriangleKey, int> trianglesOf(const TriangleMesh& mesh) {
  std::map<TriangleKey, int> triangles;
  for (std::size_t i = 0; i < mesh.indices().size(); i += 3)
    ++triangles[keyOf(mesh.positions()[mesh.indices()[i]], mesh.positions()[mesh.indices()[i + 1]],
                      mesh.positions()[mesh.indices()[i + 2]])];
  return triangles;
}

/// All that triangle_mesh.h promises of any mesh.
inline void expectPromises(const TriangleMesh& mesh) {
  ASSERT_TRUE(mesh.valid());
  const std::size_t vertices = mesh.positions().size();
  ASSERT_EQ(mesh.normals().size(), vertices);
  ASSERT_TRUE(mesh.uvs().empty() || mesh.uvs().size() == vertices);
  ASSERT_TRUE(mesh.tangents().empty() || mesh.tangents().size() == vertices);
  ASSERT_EQ(mesh.indices().size() % 3, 0u);
  ASSERT_GT(mesh.triangleCount(), 0u);

  Box bounds;
  std::vector<bool> used(vertices, false);
  for (const std::uint32_t index : mesh.indices()) {
    ASSERT_LT(index, vertices);
    used[index] = true;
  }
  for (std::uint32_t i = 0; i < vertices; ++i) {
    ASSERT_TRUE(used[i]);
    bounds.add(mesh.point(i));
    for (int k = 0; k < 3; ++k) {
      ASSERT_TRUE(std::isfinite(mesh.positions()[i][k]));
      ASSERT_NE(std::bit_cast<std::uint32_t>(mesh.positions()[i][k]), 0x80000000u) << "-0";
    }
    ASSERT_NEAR(glm::length(Vec3(mesh.normals()[i])), 1, 2e-7);
    if (!mesh.tangents().empty()) {
      const Vec4f& tangent = mesh.tangents()[i];
      ASSERT_NEAR(glm::length(Vec3(Vec3f(tangent))), 1, 2e-7);
      ASSERT_NEAR(glm::dot(Vec3(Vec3f(tangent)), Vec3(mesh.normals()[i])), 0, 1e-6);
      ASSERT_EQ(std::abs(tangent.w), 1);
    }
  }
  EXPECT_EQ(bounds, mesh.bounds());

  std::uint32_t triangle = 0;
  for (const MeshCluster& cluster : mesh.clusters()) {
    ASSERT_EQ(cluster.firstTriangle, triangle);
    ASSERT_GE(cluster.triangles, 1u);
    ASSERT_LE(cluster.triangles, kClusterTriangles);
    for (; triangle < cluster.firstTriangle + cluster.triangles; ++triangle) {
      Vec3 corners[3];
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t index = mesh.indices()[3 * std::size_t(triangle) + k];
        ASSERT_GE(index, cluster.firstVertex);
        ASSERT_LT(index - cluster.firstVertex, kWindowVertices);
        corners[k] = mesh.point(index);
        ASSERT_TRUE(cluster.bounds.contains(corners[k]));
        ASSERT_LE(glm::length(corners[k] - cluster.sphere.center), cluster.sphere.radius);
      }
      const Vec3f a = mesh.positions()[mesh.indices()[3 * std::size_t(triangle)]],
                  b = mesh.positions()[mesh.indices()[3 * std::size_t(triangle) + 1]],
                  c = mesh.positions()[mesh.indices()[3 * std::size_t(triangle) + 2]];
      const Vec3 area = glm::cross(Vec3(b) - Vec3(a), Vec3(c) - Vec3(a));
      ASSERT_NE(area, Vec3(0));
      if (cluster.spread < 1) {
        ASSERT_GE(glm::dot(unit(area), cluster.axis), std::sqrt(1 - cluster.spread * cluster.spread) - 1e-12);
      }
    }
  }
  EXPECT_EQ(triangle, mesh.triangleCount());

  std::uint32_t grouped = 0, clusters = 0;
  for (std::size_t i = 0; i < mesh.groups().size(); ++i) {
    const MeshGroup& group = mesh.groups()[i];
    EXPECT_EQ(group.firstTriangle, grouped);
    EXPECT_EQ(group.firstCluster, clusters);
    if (i > 0) {
      EXPECT_LT(mesh.groups()[i - 1].material, group.material);
    }
    for (std::uint32_t c = group.firstCluster; c < group.firstCluster + group.clusters; ++c) {
      ASSERT_EQ(mesh.clusters()[c].material, group.material);
      grouped += mesh.clusters()[c].triangles;
    }
    clusters += group.clusters;
    EXPECT_EQ(grouped, group.firstTriangle + group.triangles);
  }
  EXPECT_EQ(grouped, mesh.triangleCount());
  EXPECT_EQ(clusters, mesh.clusters().size());
}

}  // namespace luxo
