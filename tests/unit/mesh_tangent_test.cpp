// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "unit/mesh_test_support.h"

namespace luxo {
namespace {

const MeshOptions kTangents{.tangents = true};

// A strip in the plane z = 0 from x = -1 to x = 1, of two quads; u is |x|, mirrored at x = 0.
MeshArrays mirroredStrip() {
  return {.positions = {{-1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {-1, 1, 0}, {0, 1, 0}, {1, 1, 0}},
          .uvs = {{1, 1}, {0, 1}, {1, 1}, {1, 0}, {0, 0}, {1, 0}},
          .indices = {0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4}};
}

TEST(Tangents, PointWhereUGrowsAndBitangentsToTheTopOfTheImage) {
  const TriangleMesh quad = triangleMesh({.positions = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}},
                                          .uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 0}},
                                          .indices = {0, 1, 2, 0, 2, 3}},
                                         "quad", kTangents);
  expectPromises(quad);
  ASSERT_EQ(quad.tangents().size(), 4u);
  for (const Vec4f& tangent : quad.tangents()) EXPECT_EQ(tangent, Vec4f(1, 0, 0, 1));
}

TEST(Tangents, MirroredUvsHaveTangentsOfTheirOwn) {
  const TriangleMesh strip = triangleMesh(mirroredStrip(), "strip", kTangents);
  expectPromises(strip);
  ASSERT_EQ(strip.positions().size(), 8u);  // the two in the middle are doubled
  for (const MeshCluster& cluster : strip.clusters())
    for (std::size_t t = cluster.firstTriangle; t < cluster.firstTriangle + cluster.triangles; ++t) {
      float x = 0;
      for (std::size_t k = 0; k < 3; ++k) x += strip.positions()[strip.indices()[3 * t + k]].x;
      const float side = x < 0 ? -1.0f : 1.0f;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec4f tangent = strip.tangents()[strip.indices()[3 * t + k]];
        EXPECT_EQ(tangent, Vec4f(side, 0, 0, side));
        EXPECT_EQ(tangent.w * glm::cross(Vec3f(0, 0, 1), Vec3f(tangent)), Vec3f(0, 1, 0));
      }
    }
}

TEST(Tangents, OfABallAreItsParallels) {
  MeshArrays arrays = ballArrays(64, 32);
  for (const Vec3& p : arrays.positions)
    arrays.uvs.emplace_back(float(std::atan2(-p.z, p.x) / kTau), float(std::acos(p.y) / kPi));
  const TriangleMesh ball = triangleMesh(arrays, "ball", {.crease = kPi, .tangents = true});
  expectPromises(ball);
  for (std::size_t i = 0; i < ball.positions().size(); ++i) {
    const Vec3 p(ball.positions()[i]);
    // Away from the poles, and from the triangles across the seam, whose u goes all the way back.
    if (std::abs(p.y) > 0.9 || (p.x < 0 && std::abs(p.z) < 0.3)) continue;
    // Mean of triangles as large as tau/64: off by their square.
    EXPECT_GT(glm::dot(Vec3(Vec3f(ball.tangents()[i])), unit(Vec3(p.z, 0, -p.x))), 1 - 0.01);
    EXPECT_EQ(ball.tangents()[i].w, 1);
  }
}

TEST(Tangents, WithoutAreaInUvsStillPromiseWhatTheyDo) {
  MeshArrays arrays = cubeArrays();
  arrays.uvs.assign(8, Vec2f(0.5f));
  expectPromises(triangleMesh(arrays, "cube", kTangents));
  arrays.uvs[0] = Vec2f(0);
  arrays.uvs[3] = Vec2f(1, 0);
  expectPromises(triangleMesh(arrays, "cube", kTangents));
}

TEST(Tangents, NeedUvs) { EXPECT_ANY_THROW((void)triangleMesh(cubeArrays(), "cube", kTangents)); }

}  // namespace
}  // namespace luxo
