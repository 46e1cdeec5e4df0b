// SPDX-License-Identifier: Apache-2.0
// Plates far larger than the picture, in random poses: what a picture shows of them is all there, once.
#include "draw/clipped_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "scene/scene.h"
#include "surface/library.h"
#include "tessellate/tessellator.h"

namespace luxo {
namespace {

class ClippedMesh : public testing::TestWithParam<Projection> {};

INSTANTIATE_TEST_SUITE_P(Of, ClippedMesh, testing::Values(Projection::Perspective, Projection::Orthographic),
                         [](const auto& p) {
                           return p.param == Projection::Perspective ? "Perspective" : "Orthographic";
                         });

/// How far inside of its nearest edge a point of the plane y = 0 is, over the triangle's size; below 0
/// outside.
double inside(const Mesh& mesh, std::size_t triangle, const Vec3& point) {
  const auto at = [&](std::size_t k) { return mesh.positions[mesh.indices[triangle + k % 3]]; };
  const auto area = [](const Vec3& a, const Vec3& b, const Vec3& c) { return glm::cross(b - a, c - a).y; };
  double least = 1;
  for (std::size_t k = 0; k < 3; ++k)
    least = std::min(least, area(at(k), at(k + 1), point) / area(at(0), at(1), at(2)));
  return least;
}

TEST_P(ClippedMesh, ShowsEveryPointOfThePictureOnce) {
  const double side = std::exp2(21);
  const Surface surface = rectangle(side, side);
  const auto whole = std::make_shared<const Mesh>(tessellate(surface, {}, {.tolerance = 1}));
  std::mt19937 engine(11);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  };
  int met = 0, missed = 0;
  for (int pose = 0; pose < 60; ++pose) {
    Scene scene;
    const NodeId turned = scene.add(
        Node{.rotation = Rotation{unit(Vec3(1, between(-1, 1), between(-1, 1))), between(-0.3, 0.3)}});
    // The picture is near an edge of the plate.
    scene.add(Node{.parent = turned,
                   .translation = Vec3(side / 2 + between(-30, 10), between(-20, -5), between(-90, 90)),
                   .surface = surface});
    const Camera camera{.eye = Vec3(0),
                        .lookAt = Vec3(between(-1, 1), -1, between(-1, 1)),
                        .up = Vec3(0.1, 0, 1),
                        .projection = GetParam(),
                        .height = 64};
    const Snapshot snapshot = takeSnapshot(scene, 0, {96, 64}, camera);
    const VisibleList visible = cull(snapshot);
    ASSERT_EQ(visible.opaque.size(), 1u);
    const SnapshotNode& node = snapshot.nodes[0];
    const auto part = clippedMesh(snapshot.view, node, visible.opaque[0], whole);
    ASSERT_NE(part, whole);
    const View& view = snapshot.view;
    const Mat3 objectFromWorld = glm::transpose(node.worldFromObject.linear);  // a rotation
    for (int k = 0; k < 200; ++k) {
      const Vec2 across = Vec2(between(-1, 1), between(-1, 1)) * view.halfExtent;
      const Vec3 aside = across.x * view.right() + across.y * view.up();
      const Vec3 begin = view.perspective() ? view.eye : view.eye + aside;
      const Vec3 ray = view.perspective() ? view.forward() + aside : view.forward();
      const Vec3 from = objectFromWorld * (begin - node.worldFromObject.translation),
                 way = objectFromWorld * ray;
      const double depth = -from.y / way.y;
      if (!(depth > view.near)) continue;
      const Vec3 point = from + depth * way;
      // 1e-9 of a triangle: twice what doubles of this size leave of its area.
      int surely = 0, perhaps = 0;
      for (std::size_t t = 0; t < part->indices.size(); t += 3) {
        const double by = inside(*part, t, point);
        surely += by > 1e-9;
        perhaps += by > -1e-9;
      }
      const double off = side / 2 - std::max(std::abs(point.x), std::abs(point.z));
      EXPECT_LE(surely, off < -1e-6 ? 0 : 1) << pose << ' ' << k;
      EXPECT_GE(perhaps, off > 1e-6 ? 1 : 0) << pose << ' ' << k;
      ++(off > 0 ? met : missed);
    }
    // And nothing is far outside: where it is near enough to be seen so, within two pictures.
    for (const Vec3& position : part->positions) {
      const Vec3 eye = eyeFromWorldPoint(view, transformPoint(node.worldFromObject, position));
      const Vec2 pixel = pixelFromEye(view, eye);
      EXPECT_LE(std::max(std::abs(pixel.x - 48), std::abs(pixel.y - 32)), 1.5 * 96 + 1e-3);
    }
  }
  EXPECT_GT(met, 1000);
  EXPECT_GT(missed, 1000);
}

TEST(ClippedMesh, LeavesShortEdgesAlone) {
  const Surface surface = rectangle(4, 4);
  const auto whole = std::make_shared<const Mesh>(tessellate(surface, {}, {.tolerance = 1}));
  Scene scene;
  scene.add(Node{.surface = surface});
  const Snapshot snapshot = takeSnapshot(scene, 0, {96, 64}, Camera{.eye = Vec3(0, 5, 1)});
  const VisibleList visible = cull(snapshot);
  ASSERT_EQ(visible.opaque.size(), 1u);
  EXPECT_EQ(clippedMesh(snapshot.view, snapshot.nodes[0], visible.opaque[0], whole), whole);
}

}  // namespace
}  // namespace luxo
