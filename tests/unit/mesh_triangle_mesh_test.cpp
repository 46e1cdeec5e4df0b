// SPDX-License-Identifier: Apache-2.0
#include "mesh/triangle_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "base/error.h"
#include "unit/mesh_test_support.h"

namespace luxo {
namespace {

using ::testing::HasSubstr;

std::string refusalOf(const MeshArrays& arrays, const MeshOptions& options = {}) {
  try {
    const TriangleMesh mesh = triangleMesh(arrays, "thing", options);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::Scene);
    return error.what();
  }
  return {};
}

MeshArrays oneTriangle() { return {.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .indices = {0, 1, 2}}; }

/// By the divergence theorem: positive where fronts are outside.
double volumeOf(const TriangleMesh& mesh) {
  double volume = 0;
  for (std::size_t i = 0; i < mesh.indices().size(); i += 3)
    volume += glm::dot(mesh.point(mesh.indices()[i]),
                       glm::cross(mesh.point(mesh.indices()[i + 1]), mesh.point(mesh.indices()[i + 2]))) /
              6;
  return volume;
}

TEST(TriangleMesh, OfACubeHasItsPointsFacesAndEdges) {
  const TriangleMesh cube = triangleMesh(cubeArrays(), "cube");
  expectPromises(cube);
  EXPECT_EQ(cube.name(), "cube");
  EXPECT_EQ(cube.triangleCount(), 12u);
  EXPECT_EQ(cube.positions().size(), 24u);  // its edges are creases, so each corner has three normals
  EXPECT_EQ(cube.bounds(), (Box{Vec3(-1), Vec3(1)}));
  EXPECT_TRUE(cube.closed());
  EXPECT_EQ(cube.edges().border + cube.edges().turned + cube.edges().nonManifold, 0u);
  for (std::size_t i = 0; i < 24; ++i)
    EXPECT_EQ(glm::dot(cube.positions()[i], cube.normals()[i]), 1);  // outward, along an axis
}

TEST(TriangleMesh, SmoothNormalsOfABallAreItsRadii) {
  const TriangleMesh ball = triangleMesh(ballArrays(64, 32), "ball");
  expectPromises(ball);
  EXPECT_EQ(ball.positions().size(), ballArrays(64, 32).positions.size());
  EXPECT_TRUE(ball.closed());
  // The mean of the triangles around a vertex is off by the square of their size, (tau/64)^2 = 0.01.
  for (std::size_t i = 0; i < ball.positions().size(); ++i)
    EXPECT_GT(glm::dot(ball.positions()[i], ball.normals()[i]), 1 - 1e-4);
}

TEST(TriangleMesh, NormalsAreWeighedByAngles) {
  // A corner of a cube, smooth: its three faces count the same, though two of them are two triangles there.
  MeshArrays arrays = cubeArrays();
  const TriangleMesh cube = triangleMesh(arrays, "cube", {.crease = radians(100)});
  EXPECT_EQ(cube.positions().size(), 8u);
  for (std::size_t i = 0; i < 8; ++i)
    EXPECT_NEAR(glm::dot(Vec3(cube.positions()[i]), Vec3(cube.normals()[i])), std::sqrt(3.0), 1e-6);
}

TEST(TriangleMesh, FlatNormalsAreThoseOfTheTriangles) {
  MeshArrays arrays = ballArrays(16, 8);
  arrays.normals.assign(arrays.positions.size(), Vec3f(0, 0, 1));
  const TriangleMesh ball = triangleMesh(arrays, "ball", {.normals = NormalRule::Flat});
  expectPromises(ball);
  for (std::size_t i = 0; i < ball.indices().size(); i += 3) {
    const Vec3 a = ball.point(ball.indices()[i]), b = ball.point(ball.indices()[i + 1]),
               c = ball.point(ball.indices()[i + 2]);
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_GT(glm::dot(unit(glm::cross(b - a, c - a)), Vec3(ball.normals()[ball.indices()[i + k]])),
                1 - 1e-6);
  }
}

TEST(TriangleMesh, GivenNormalsStayAndMissingOnesAreMade) {
  MeshArrays arrays = cubeArrays();
  arrays.normals.assign(8, Vec3f(0));
  arrays.normals[7] = Vec3f(3, 0, 4);
  const TriangleMesh cube = triangleMesh(arrays);
  expectPromises(cube);
  EXPECT_EQ(cube.positions().size(), 7 * 3 + 1u);
  for (std::size_t i = 0; i < cube.positions().size(); ++i)
    if (cube.positions()[i] == Vec3f(1)) {
      EXPECT_LT(glm::distance(cube.normals()[i], Vec3f(0.6f, 0, 0.8f)), 2e-7f);
    }
}

TEST(TriangleMesh, FrontsAreWhereGivenNormalsPointTo) {
  const MeshArrays ball = ballArrays(8, 6);
  MeshArrays turned = ball;
  for (std::size_t i = 0; i < turned.indices.size(); i += 3)
    std::swap(turned.indices[i + 1], turned.indices[i + 2]);
  EXPECT_LT(volumeOf(triangleMesh(turned, "turned")), 0) << "no normals tell";
  turned.normals.assign(turned.positions.begin(), turned.positions.end());
  turned.normals[3] = -turned.normals[3];  // most of them do
  EXPECT_NEAR(volumeOf(triangleMesh(turned, "turned")), volumeOf(triangleMesh(ball, "ball")), 1e-6);
}

TEST(TriangleMesh, SmoothingNumbersDecideWhatIsSharp) {
  MeshArrays arrays = cubeArrays();
  arrays.smoothing.assign(12, 1);
  EXPECT_EQ(triangleMesh(arrays).positions().size(), 8u);
  arrays.smoothing[0] = arrays.smoothing[1] = 2;  // the face z = -1, whose edges are sharp now
  EXPECT_EQ(triangleMesh(arrays).positions().size(), 4 + 4 + 4u);
  arrays.smoothing.assign(12, 0);
  EXPECT_EQ(triangleMesh(arrays).positions().size(), 24u);
}

TEST(TriangleMesh, WeldsEqualVerticesOnly) {
  MeshArrays arrays = oneTriangle();
  arrays.positions.insert(arrays.positions.end(), {{1, 0, 0}, {1, 1, 0}, {-0.0, 1, 0}});
  arrays.indices.insert(arrays.indices.end(), {3, 4, 5});
  EXPECT_EQ(triangleMesh(arrays).positions().size(), 4u);
  arrays.uvs.assign(6, Vec2f(0));
  EXPECT_EQ(triangleMesh(arrays).positions().size(), 4u);
  arrays.uvs[3] = Vec2f(0, 1);
  const TriangleMesh seam = triangleMesh(arrays);
  EXPECT_EQ(seam.positions().size(), 5u);
  EXPECT_EQ(seam.edges().border, 4u);  // the seam of uvs is no border
}

// Vertices of one place that come from two stay two, each with where it came from, tangents or not.
TEST(TriangleMesh, WhatHasMovedTellsWhereItWas) {
  MeshArrays arrays = oneTriangle();
  arrays.positions.insert(arrays.positions.end(), {{1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  arrays.indices.insert(arrays.indices.end(), {3, 4, 5});
  arrays.normals.assign(6, Vec3f(0, 0, 1));
  arrays.uvs = {{0, 0}, {1, 0}, {0, 1}, {1, 0}, {1, 1}, {0, 1}};
  for (const Vec3& p : arrays.positions) arrays.rest.emplace_back(p + Vec3(5, 0, 0));
  arrays.restNormals.assign(6, Vec3f(1, 0, 0));
  EXPECT_EQ(triangleMesh(arrays).positions().size(), 4u);
  arrays.rest[3] = Vec3f(7, 0, 0);
  for (const bool tangents : {false, true}) {
    const TriangleMesh mesh = triangleMesh(arrays, "m", {.tangents = tangents});
    ASSERT_EQ(mesh.rest().size(), mesh.positions().size());
    ASSERT_EQ(mesh.restNormals().size(), mesh.positions().size());
    EXPECT_GE(mesh.rest().size(), 5u);
    std::size_t moved = 0;
    for (std::size_t i = 0; i < mesh.rest().size(); ++i) {
      const bool other = mesh.rest()[i] == Vec3f(7, 0, 0);
      moved += other;
      EXPECT_EQ(mesh.rest()[i] == mesh.positions()[i] + Vec3f(5, 0, 0), !other);
    }
    EXPECT_EQ(moved, 1u);
  }
  EXPECT_TRUE(triangleMesh(oneTriangle()).rest().empty());
  arrays.restNormals.pop_back();
  EXPECT_THROW(static_cast<void>(triangleMesh(arrays)), Error);
  arrays.restNormals.clear();
  EXPECT_THROW(static_cast<void>(triangleMesh(arrays)), Error);
  arrays.restNormals.assign(6, Vec3f(1, 0, 0));
  arrays.rest[0].x = std::numeric_limits<float>::infinity();
  EXPECT_THROW(static_cast<void>(triangleMesh(arrays)), Error);
}

TEST(TriangleMesh, CountsEdgesByThePointsTheyJoin) {
  const MeshEdges open = triangleMesh(oneTriangle()).edges();
  EXPECT_EQ(open.border, 3u);
  EXPECT_FALSE(open.closed());

  MeshArrays missing = cubeArrays();
  missing.indices.resize(33);
  EXPECT_EQ(triangleMesh(missing).edges().border, 3u);

  MeshArrays turned = cubeArrays();
  std::swap(turned.indices[0], turned.indices[1]);
  EXPECT_EQ(triangleMesh(turned).edges().turned, 3u);
  EXPECT_FALSE(triangleMesh(turned).closed());

  // Two tetrahedra that share an edge: four triangles at it, two each way.
  const MeshArrays tetrahedra{
      .positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}},
      .indices = {0, 1, 3, 0, 2, 1, 0, 3, 2, 1, 2, 3, 0, 1, 5, 0, 4, 1, 0, 5, 4, 1, 4, 5}};
  const MeshEdges shared = triangleMesh(tetrahedra).edges();
  EXPECT_EQ(shared.nonManifold, 1u);
  EXPECT_EQ(shared.border, 0u);
  EXPECT_TRUE(shared.closed());
}

TEST(TriangleMesh, TrianglesWithoutAreaAreLeftOutAndTheWholeStaysClosed) {
  MeshArrays arrays = cubeArrays();
  // The edge from vertex 0 to vertex 1 gets a point in its middle on one side, and a sliver fills the gap.
  arrays.positions.emplace_back(0, -1, -1);
  arrays.indices.erase(arrays.indices.begin() + 3, arrays.indices.begin() + 6);
  arrays.indices.insert(arrays.indices.end(), {0, 3, 8, 8, 3, 1, 0, 8, 1});
  arrays.indices.insert(arrays.indices.end(), {4, 4, 5});
  const TriangleMesh mesh = triangleMesh(arrays);
  expectPromises(mesh);
  EXPECT_EQ(mesh.dropped(), 2u);
  EXPECT_EQ(mesh.triangleCount(), 13u);
  EXPECT_TRUE(mesh.closed());
}

TEST(TriangleMesh, FarFromTheOriginItsPointsAreExactToItsSize) {
  const Vec3 far(4e6, -3e5, 1e7);
  const MeshArrays arrays = ballArrays(32, 16, far);
  const TriangleMesh ball = triangleMesh(arrays, "ball", {.crease = kPi});
  expectPromises(ball);
  EXPECT_GT(glm::length(ball.origin()), 1e7);
  ASSERT_EQ(ball.positions().size(), arrays.positions.size());
  for (std::uint32_t i = 0; i < arrays.positions.size(); ++i) {
    double nearest = 1;
    for (const Vec3& given : arrays.positions)
      nearest = std::min(nearest, glm::distance(given, ball.point(i)));
    EXPECT_LT(nearest, 2 * 1.8 / (1 << 24) + 1e-8);
  }
  EXPECT_EQ(triangleMesh(ballArrays(32, 16)).origin(), Vec3(0));
}

TEST(TriangleMesh, MaterialsAreGroupsInTheirOrder) {
  MeshArrays arrays = ballArrays(40, 20);
  for (std::size_t i = 0; i < arrays.indices.size() / 3; ++i)
    arrays.materials.push_back(std::uint32_t(i * 7 % 3) * 2);
  const TriangleMesh ball = triangleMesh(arrays);
  expectPromises(ball);
  ASSERT_EQ(ball.groups().size(), 3u);
  std::map<TriangleKey, std::uint32_t> given;
  for (std::size_t i = 0; i < arrays.materials.size(); ++i)
    given[keyOf(Vec3f(arrays.positions[arrays.indices[3 * i]]),
                Vec3f(arrays.positions[arrays.indices[3 * i + 1]]),
                Vec3f(arrays.positions[arrays.indices[3 * i + 2]]))] = arrays.materials[i];
  EXPECT_EQ(given.size(), arrays.materials.size());
  for (const MeshGroup& group : ball.groups())
    for (std::size_t i = group.firstTriangle; i < group.firstTriangle + group.triangles; ++i)
      EXPECT_EQ(
          given.at(keyOf(ball.positions()[ball.indices()[3 * i]], ball.positions()[ball.indices()[3 * i + 1]],
                         ball.positions()[ball.indices()[3 * i + 2]])),
          group.material);
}

TEST(TriangleMesh, ManyVerticesStayWithin16BitsOfTheirClusters) {
  const MeshArrays arrays = ballArrays(500, 250);  // 124,502 vertices
  const TriangleMesh ball = triangleMesh(arrays);
  expectPromises(ball);
  EXPECT_EQ(ball.triangleCount(), arrays.indices.size() / 3);
  EXPECT_LT(ball.positions().size(),
            double(arrays.positions.size()) * 1.02);  // those at the border of two ranges are doubled
  EXPECT_EQ(trianglesOf(ball).size(), arrays.indices.size() / 3);
  EXPECT_TRUE(ball.closed());
}

TEST(TriangleMesh, ClustersFaceAwayOnlyWhereNoTriangleShowsItsFront) {
  const TriangleMesh ball = triangleMesh(ballArrays(96, 48, Vec3(3, 1, -2)));
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> between(-1, 1);
  std::size_t away = 0, along = 0, possible = 0;
  for (int i = 0; i < 200; ++i) {
    const Vec3 direction = unit(Vec3(between(random), between(random), between(random))),
               eye = Vec3(3, 1, -2) - (1.05 + 3 * std::abs(between(random))) * direction;
    for (const MeshCluster& cluster : ball.clusters()) {
      bool front = false, frontAlong = false;
      for (std::size_t t = cluster.firstTriangle; t < cluster.firstTriangle + cluster.triangles; ++t) {
        const Vec3 a = ball.point(ball.indices()[3 * t]), b = ball.point(ball.indices()[3 * t + 1]),
                   c = ball.point(ball.indices()[3 * t + 2]), normal = glm::cross(b - a, c - a);
        front |= glm::dot(normal, eye - a) > 0;
        frontAlong |= glm::dot(normal, direction) < 0;
      }
      if (cluster.behind(Vec4(eye, 1)) > 0) {
        EXPECT_FALSE(front);
        ++away;
      }
      if (cluster.behind(Vec4(-direction, 0)) > 0) {
        EXPECT_FALSE(frontAlong);
        ++along;
      }
      possible += !frontAlong;
    }
  }
  EXPECT_GT(along, possible / 2);
  EXPECT_GT(away, along / 2);
}

TEST(TriangleMesh, OfShuffledTrianglesClustersAreNeighboursThatFaceAlike) {
  MeshArrays arrays = ballArrays(96, 48);
  const std::size_t triangles = arrays.indices.size() / 3;
  std::mt19937_64 random(3);
  for (std::size_t i = triangles - 1; i > 0; --i)
    std::swap_ranges(arrays.indices.begin() + std::ptrdiff_t(3 * i),
                     arrays.indices.begin() + std::ptrdiff_t(3 * i + 3),
                     arrays.indices.begin() + std::ptrdiff_t(3 * (random() % i)));
  for (const double scale : {1.0, 1e-30, 9e17}) {
    MeshArrays scaled = arrays;
    for (Vec3& position : scaled.positions) position *= scale;
    const TriangleMesh ball = triangleMesh(scaled);
    expectPromises(ball);
    EXPECT_EQ(ball.triangleCount(), triangles);
    // A disc of 128 of 9,024 triangles has the radius 2 sqrt(128 / 9024) = 0.24 and the spread of its angle;
    // in the order given both are 1.
    double radius = 0, spread = 0;
    for (const MeshCluster& cluster : ball.clusters()) {
      radius += cluster.sphere.radius / scale;
      spread += cluster.spread;
    }
    EXPECT_LT(radius / double(ball.clusters().size()), 2 * 0.24) << scale;
    EXPECT_LT(spread / double(ball.clusters().size()), 2 * 0.24) << scale;
    EXPECT_LT(ball.clusters().size(), 2 * triangles / kClusterTriangles);
    // Vertices that a cache of the last 16 lacks, a triangle: 0.5 at best, 3 in the order given.
    std::vector<std::uint32_t> cache(16, 0xffffffff);
    std::size_t misses = 0;
    for (const std::uint32_t index : ball.indices())
      if (std::find(cache.begin(), cache.end(), index) == cache.end()) {
        cache[misses++ % cache.size()] = index;
      }
    EXPECT_LT(double(misses) / double(triangles), 1) << scale;
  }
}

TEST(TriangleMesh, TheSidesOfAThinWallAreClustersOfTheirOwn) {
  // Two sheets of 2 x 64 x 64 triangles, a hundredth of a square apart: by place alone both were in each
  // cluster.
  constexpr std::uint32_t kSquares = 64;
  MeshArrays wall;
  for (std::uint32_t side = 0; side < 2; ++side)
    for (std::uint32_t y = 0; y <= kSquares; ++y)
      for (std::uint32_t x = 0; x <= kSquares; ++x) wall.positions.emplace_back(x, y, 0.01 * side);
  constexpr std::uint32_t kRow = kSquares + 1, kSide = kRow * kRow;
  for (std::uint32_t y = 0; y < kSquares; ++y)
    for (std::uint32_t x = 0; x < kSquares; ++x) {
      const std::uint32_t a = y * kRow + x, b = a + 1, c = a + kRow, d = c + 1;
      wall.indices.insert(wall.indices.end(), {a, d, b, a, c, d});
      wall.indices.insert(wall.indices.end(),
                          {kSide + a, kSide + b, kSide + d, kSide + a, kSide + d, kSide + c});
    }
  const TriangleMesh mesh = triangleMesh(wall);
  expectPromises(mesh);
  EXPECT_EQ(mesh.clusters().size(), 2 * 2 * kSquares * kSquares / kClusterTriangles);
  for (const MeshCluster& cluster : mesh.clusters()) {
    EXPECT_LT(cluster.spread, 1e-6);
    // Squares of 8 x 8, if the splits are where triangles spread most.
    EXPECT_LT(cluster.sphere.radius, 0.5 * std::hypot(10, 10));
  }
}

TEST(TriangleMesh, ManyMaterialsCostWhatTheirTrianglesDo) {
  // 20,000 groups of a triangle each: with a pass over all vertices for each this would take minutes.
  MeshArrays arrays = ballArrays(100, 101);
  for (std::uint32_t i = 0; i < arrays.indices.size() / 3; ++i) arrays.materials.push_back(i);
  const TriangleMesh ball = triangleMesh(arrays);
  EXPECT_EQ(ball.groups().size(), 20'000u);
  EXPECT_EQ(ball.clusters().size(), 20'000u);
}

TEST(TriangleMesh, CopiesAreOneMesh) {
  const TriangleMesh a = triangleMesh(oneTriangle()), b = a, c = triangleMesh(oneTriangle());
  EXPECT_EQ(a, b);
  EXPECT_NE(a, c);
  EXPECT_EQ(a.identity(), b.identity());
  EXPECT_FALSE(TriangleMesh().valid());
}

TEST(TriangleMesh, RefusesWhatIsNoMesh) {
  MeshArrays arrays = oneTriangle();
  arrays.indices = {0, 1};
  EXPECT_THAT(refusalOf(arrays), HasSubstr("mesh 'thing': 2 indices are not three a triangle"));
  arrays.indices = {0, 1, 3};
  EXPECT_THAT(refusalOf(arrays), HasSubstr("triangle 0 has vertex 3 of 3"));
  arrays.indices = {0, 1, 1};
  EXPECT_THAT(refusalOf(arrays), HasSubstr("no triangle with an area"));
  EXPECT_THAT(refusalOf({}), HasSubstr("no triangle with an area"));
  EXPECT_FALSE(hasArea({}));

  for (const double bad : {kInfinity, -kInfinity, std::numeric_limits<double>::quiet_NaN(), 1.1e18}) {
    arrays = oneTriangle();
    arrays.positions[1].y = bad;
    EXPECT_THAT(refusalOf(arrays), HasSubstr("vertex 1 is (1, "));
  }
  arrays = oneTriangle();
  arrays.normals.resize(2);
  EXPECT_THAT(refusalOf(arrays), HasSubstr("2 normals, not 3"));
  arrays.normals.assign(3, Vec3f(std::numeric_limits<float>::quiet_NaN()));
  EXPECT_THAT(refusalOf(arrays), HasSubstr("the normal of vertex 0 is not finite"));
  arrays = oneTriangle();
  arrays.uvs.assign(3, Vec2f(float(kInfinity)));
  EXPECT_THAT(refusalOf(arrays), HasSubstr("the uv of vertex 0 is not finite"));
  arrays = oneTriangle();
  arrays.materials = {0, 0};
  EXPECT_THAT(refusalOf(arrays), HasSubstr("2 materials, not 1"));
}

}  // namespace
}  // namespace luxo
