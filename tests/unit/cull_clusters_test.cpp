// SPDX-License-Identifier: Apache-2.0
// Clusters that are left out are outside the picture, or would be rasterised as the face that is not drawn
// however their corners move.
#include "cull/clusters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "mesh_test_support.h"
#include "scene_test_support.h"
#include "surface/surface_triangles.h"

namespace luxo {
namespace {

constexpr PixelSize kClusterView{640, 480};

/// A ball with dents, or some of it.
TriangleMesh dentedBall(test::Random& random, int rings, double part = 1) {
  const double dents = random.uniform(0, 0.3), waves = 1 + random.below(6);
  MeshArrays arrays;
  const int around = 2 * rings;
  for (int i = 0; i <= rings; ++i)
    for (int j = 0; j < around; ++j) {
      const double v = kPi * part * i / rings, u = kTau * j / around;
      const double r = 1 + dents * std::sin(waves * u) * std::sin(v) * std::sin(v);
      arrays.positions.push_back(r *
                                 Vec3(std::sin(v) * std::cos(u), std::cos(v), -std::sin(v) * std::sin(u)));
    }
  const auto vertex = [&](int i, int j) { return std::uint32_t(i * around + j % around); };
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < around; ++j)
      arrays.indices.insert(arrays.indices.end(), {vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1),
                                                   vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
  return triangleMesh(std::move(arrays), "dented ball");
}

Camera anyCamera(test::Random& random) {
  return {.eye = random.uniform(0.2, 6) * random.direction(),
          .lookAt = random.inCube(1),
          .fovY = radians(random.uniform(10, 120)),
          .projection = random.below(4) ? Projection::Perspective : Projection::Orthographic,
          .height = random.uniform(0.5, 4)};
}

/// Of each triangle, whether it is drawn.
std::vector<bool> inRanges(const std::vector<TriangleRange>& ranges, std::uint32_t triangles) {
  std::vector<bool> drawn(triangles);
  for (const TriangleRange& range : ranges) std::fill_n(drawn.begin() + range.first, range.count, true);
  return drawn;
}

/// Whether all corners are beyond one plane of what is drawn.
bool isOutside(const Frustum& frustum, const std::array<Vec3, 3>& world) {
  return std::ranges::any_of(frustum.planes, [&](const Plane& plane) {
    return std::ranges::all_of(world,
                               [&](const Vec3& p) { return glm::dot(plane.normal, p) + plane.offset < 0; });
  });
}

/// Twice the area in the picture, positive where the front is seen, of corners that are moved by as much as
/// any device may.
double frontArea(const View& view, const SnapshotNode& node, const std::array<Vec3, 3>& object,
                 test::Random& random) {
  std::array<Vec2, 3> pixels;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 eye = transformPoint(eyeFromObject(view, node.worldFromObject), object[k]);
    pixels[k] = pixelFromEye(view, eye) + Vec2(random.below(2) ? 1 : -1, random.below(2) ? 1 : -1) / 32.0;
  }
  const Vec2 a = pixels[1] - pixels[0], b = pixels[2] - pixels[0];
  const double clockwise = a.x * b.y - a.y * b.x;  // as y is down
  return mirrors(node.worldFromObject) ? clockwise : -clockwise;
}

class ClusterCullingOf : public testing::TestWithParam<Faces> {};

INSTANTIATE_TEST_SUITE_P(Faces, ClusterCullingOf, testing::Values(Faces::Both, Faces::Front, Faces::Back));

TEST_P(ClusterCullingOf, OnlyLeavesOutWhatIsOutsideOrShowsTheOtherFace) {
  test::Random random(31);
  std::uint64_t outside = 0, turned = 0, all = 0;
  for (int i = 0; i < 150; ++i) {
    Scene scene;
    const Vec3 scale = random.below(3) ? random.scale() : Vec3(random.below(2) ? 1 : -1);
    scene.add(Node{.translation = random.inCube(0.5),
                   .rotation = random.rotation(),
                   .scale = scale,
                   .surface = dentedBall(random, 24 + random.below(40), random.uniform(0.4, 1))});
    const Snapshot snapshot = takeSnapshot(scene, 0, kClusterView, anyCamera(random));
    const View view =
        random.below(2) ? snapshot.view : sampledAt(snapshot.view, {random.uniform(-0.5, 0.5), 0.3});
    const SnapshotNode& node = snapshot.nodes[0];
    const SurfaceTriangles& triangles = *node.surface.triangles();
    const ClusterCulling culling(view, {});
    ClusterCounts counts;
    const auto drawn = inRanges(culling.drawn(node, {.faces = GetParam()}, counts), triangles.count);
    all += triangles.count;
    std::uint64_t left = 0;
    const Frustum picture = frustumOf(view, 0.5);
    for (std::uint32_t t = 0; t < triangles.count; ++t) {
      if (drawn[t]) continue;
      ++left;
      const std::array<Vec3, 3> object = triangles.points(t);
      std::array<Vec3, 3> world;
      std::ranges::transform(object, world.begin(),
                             [&](const Vec3& p) { return transformPoint(node.worldFromObject, p); });
      if (isOutside(picture, world)) {
        ++outside;
        continue;
      }
      if (isOutside(frustumOf(view, 0), world)) continue;  // in the margin
      ++turned;
      ASSERT_NE(GetParam(), Faces::Both);
      for (int k = 0; k < 8; ++k) {
        const double area = frontArea(view, node, object, random);
        ASSERT_TRUE(GetParam() == Faces::Front ? area < 0 : area > 0) << "scene " << i << ", triangle " << t;
      }
    }
    ASSERT_EQ(left, counts.culledFrustum + counts.culledBackface);
  }
  EXPECT_GT(outside, all / 7);
  if (GetParam() != Faces::Both) {
    EXPECT_GT(turned, all / 100);
  }
}

/// All of a ball in view, from so many metres.
Snapshot ballFrom(double metres) {
  test::Random random(5);
  Scene scene;
  scene.add(Node{.surface = dentedBall(random, 120)});
  return takeSnapshot(scene, 0, kClusterView,
                      {.eye = Vec3(0, 2, metres), .lookAt = Vec3(0), .fovY = radians(7)});
}

TEST(ClusterCulling, OfABallInFullViewAboutHalfShowsItsBack) {
  const Snapshot snapshot = ballFrom(20);
  const std::uint32_t triangles = snapshot.nodes[0].surface.triangles()->count;
  ClusterCounts counts;
  const ClusterCulling culling(snapshot.view, {});
  static_cast<void>(culling.drawn(snapshot.nodes[0], {.faces = Faces::Front}, counts));
  EXPECT_EQ(counts.culledFrustum, 0U);
  EXPECT_GT(counts.culledBackface, triangles / 7);
  EXPECT_LT(counts.culledBackface, triangles / 2);

  const ClusterCulling none(snapshot.view, {.frustum = false, .backface = false});
  ClusterCounts nothing;
  const auto all = none.drawn(snapshot.nodes[0], {.faces = Faces::Front}, nothing);
  EXPECT_EQ(all, (std::vector{TriangleRange{0, triangles}}));
  EXPECT_EQ(nothing.culledBackface, 0U);
}

// As small as this no triangle is sure to keep its orientation on a raster of 1/16 pixel.
TEST(ClusterCulling, TrianglesSmallerThanTheRastersGridStay) {
  const Snapshot snapshot = ballFrom(2000);
  ClusterCounts counts;
  static_cast<void>(
      ClusterCulling(snapshot.view, {}).drawn(snapshot.nodes[0], {.faces = Faces::Front}, counts));
  EXPECT_EQ(counts.culledBackface, 0U);
}

}  // namespace
}  // namespace luxo
