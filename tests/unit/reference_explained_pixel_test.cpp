// SPDX-License-Identifier: Apache-2.0
// What is told of a pixel against equations: where the ray meets what, how that bends, what light it gets.
#include "reference/explained_pixel.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesh/triangle_mesh.h"
#include "reference/reference.h"
#include "surface/library.h"
#include "unit/scene_test_support.h"

namespace luxo {
namespace {

using test::expectNear;

constexpr PixelSize kExplainedSize{64, 48};

Scene looking() {
  Scene scene;
  scene.set(RenderSettings{.size = kExplainedSize, .background = {0.1, 0.2, 0.3}, .ambient = Vec3(0.25)});
  scene.add(Camera{.eye = Vec3(0, 0, 10), .lookAt = Vec3(0), .fovY = radians(40), .near = 0.1});
  return scene;
}

ExplainedPixel explained(const Scene& scene, const Vec2& at = {32, 24}) {
  return explainPixel(takeSnapshot(scene, 0, kExplainedSize), at);
}

// A ball that is seen in its middle: everything is known.
TEST(ExplainedPixel, OfABall) {
  Scene scene = looking();
  const MaterialId red = scene.add(Material{.name = "red", .diffuse = {0.5, 0.1, 0}, .specular = Vec3(0)});
  scene.add(Node{.name = "ball", .translation = Vec3(0, 0, 1), .surface = sphere(2), .material = red});
  scene.add(Node{.name = "bulb",
                 .translation = Vec3(0, 3, 3),
                 .light = Light{.intensity = 9, .attenuation = Light::Attenuation::InverseSquare}});
  const ExplainedPixel pixel = explained(scene);
  expectNear(pixel.direction, {0, 0, -1}, 1e-15);
  EXPECT_TRUE(pixel.certified);
  ASSERT_EQ(pixel.points.size(), 2U);
  const PointOnRay& near = pixel.points[0];
  EXPECT_TRUE(near.seen);
  EXPECT_TRUE(near.front);
  EXPECT_TRUE(near.certified);
  expectNear(near.position, {0, 0, 3}, 1e-12);
  expectNear(near.positionObject, {0, 0, 2}, 1e-12);
  EXPECT_NEAR(near.depth, 7, 1e-12);
  expectNear(near.outward, {0, 0, 1}, 1e-12);
  EXPECT_NEAR(near.curvature.value().gaussian, 0.25, 1e-12);
  EXPECT_NEAR(near.curvature.value().mean, 0.5, 1e-12);
  EXPECT_LT(near.residualPx.value(), 1e-9);
  // The bulb stands above the point, at a right angle to its normal: the half vector's cosine does not count.
  ASSERT_EQ(near.lights.size(), 1U);
  EXPECT_NEAR(near.lights[0].cosine, 0, 1e-12);
  EXPECT_NEAR(near.lights[0].distance, 3, 1e-12);
  expectNear(near.ambient, {0.125, 0.025, 0}, 1e-15);

  const PointOnRay& far = pixel.points[1];
  EXPECT_FALSE(far.seen);
  EXPECT_FALSE(far.front);
  expectNear(far.position, {0, 0, -1}, 1e-12);
  expectNear(far.outward, {0, 0, -1}, 1e-12);
  EXPECT_TRUE(far.lights.empty());
}

TEST(ExplainedPixel, SharesOfLightsAddUpToWhatIsSeen) {
  Scene scene = looking();
  const MaterialId grey = scene.add(Material{.diffuse = Vec3(0.5), .specular = Vec3(0)});
  const NodeId wall = scene.add(Node{.name = "wall",
                                     .rotation = Rotation{{1, 0, 0}, kPi / 2},
                                     .surface = rectangle(8, 8),
                                     .material = grey});
  const NodeId ball =
      scene.add(Node{.name = "ball", .translation = Vec3(0, 2, 2), .surface = sphere(0.5), .material = grey});
  const auto shining = [&](const char* name, const Vec3& from) {
    return scene.add(Node{.name = name,
                          .translation = from,
                          .light = Light{.intensity = 8,
                                         .attenuation = Light::Attenuation::InverseSquare,
                                         .shadow = Light::Shadow::Exact,
                                         .casters = {wall, ball}}});
  };
  const NodeId open = shining("open", {0, 0, 4}), hidden = shining("hidden", {0, 4, 4}),
               behind = shining("behind", {0, 0, -4});
  const ExplainedPixel pixel = explained(scene);
  ASSERT_EQ(pixel.points.size(), 1U);
  const PointOnRay& point = pixel.points[0];
  expectNear(point.position, {0, 0, 0}, 1e-12);
  ASSERT_EQ(point.lights.size(), 3U);
  const LightOnPoint &a = point.lights[0], &b = point.lights[1], &c = point.lights[2];
  EXPECT_EQ(a.light, open);
  expectNear(a.share, Vec3(0.25), 1e-12);  // 0.5 * 8 / 16
  EXPECT_EQ(a.visibility, Vec3(1));
  EXPECT_EQ(b.light, hidden);
  EXPECT_TRUE(b.faces);
  expectNear(b.unshadowed, Vec3(0.5 * 8 / 32 * std::sqrt(0.5)), 1e-12);
  EXPECT_EQ(b.visibility, Vec3(0));
  EXPECT_EQ(b.share, Vec3(0));
  EXPECT_EQ(c.light, behind);
  EXPECT_FALSE(c.faces);
  EXPECT_EQ(c.unshadowed, Vec3(0));
  expectNear(point.reflected, Vec3(0.125 + 0.25), 1e-12);
  expectNear(pixel.color, point.reflected, 1e-12);
}

TEST(ExplainedPixel, LayersAreToldInTheirOrder) {
  Scene scene = looking();
  const MaterialId glass = scene.add(Material{.name = "glass", .diffuse = Vec3(0.4), .opacity = 0.25});
  const MaterialId wood = scene.add(Material{.name = "wood"});
  scene.add(Node{.name = "back", .translation = Vec3(0, 0, -3), .surface = sphere(1), .material = wood});
  scene.add(Node{.name = "pane",
                 .translation = Vec3(0, 0, 4),
                 .rotation = Rotation{{1, 0, 0}, kPi / 2},
                 .surface = rectangle(8, 8),
                 .material = glass});
  scene.add(Node{.name = "front", .surface = sphere(1), .material = wood});
  const ExplainedPixel pixel = explained(scene);
  std::vector<double> depths;
  std::vector<bool> seen;
  for (const PointOnRay& point : pixel.points) {
    depths.push_back(std::round(point.depth * 1e6) / 1e6);
    seen.push_back(point.seen);
  }
  EXPECT_EQ(depths, (std::vector<double>{6, 9, 11, 12, 14}));
  EXPECT_EQ(seen, (std::vector<bool>{true, true, false, false, false}));
  EXPECT_EQ(pixel.points[0].opacity, 0.25);
  expectNear(pixel.color, 0.25 * pixel.points[0].reflected + 0.75 * pixel.points[1].reflected, 1e-12);
}

// An open surface from behind: its own normal, and the one that is lit.
TEST(ExplainedPixel, BothNormalsOfAnOpenSurface) {
  Scene scene = looking();
  scene.add(Node{.rotation = Rotation{{1, 0, 0}, -kPi / 2}, .surface = rectangle(2, 2)});
  const ExplainedPixel pixel = explained(scene);
  ASSERT_EQ(pixel.points.size(), 1U);
  expectNear(pixel.points[0].outward, {0, 0, -1}, 1e-12);
  expectNear(pixel.points[0].lit, {0, 0, 1}, 1e-12);
  EXPECT_FALSE(pixel.points[0].front);
}

TEST(ExplainedPixel, OfTriangles) {
  Scene scene = looking();
  scene.add(Node{.translation = Vec3(0, 0, 2),
                 .surface = triangleMesh({.positions = {{-1, -1, 0}, {1, -1, 0}, {0, 2, 0}},
                                          .normals = {{1, 0, 1}, {1, 0, 1}, {1, 0, 1}},
                                          .uvs = {{0, 0}, {1, 0}, {0.5, 1}},
                                          .indices = {0, 1, 2}})});
  const ExplainedPixel pixel = explained(scene);
  ASSERT_EQ(pixel.points.size(), 1U);
  const PointOnRay& point = pixel.points[0];
  expectNear(point.position, {0, 0, 2}, 1e-12);
  expectNear(point.positionObject, {0, 0, 0}, 1e-12);
  expectNear(point.outward, {0, 0, 1}, 1e-7);
  expectNear(point.lit, Vec3(std::sqrt(0.5), 0, std::sqrt(0.5)), 1e-6);
  EXPECT_NEAR(point.parameters.y, 1.0 / 3, 1e-7);
  EXPECT_FALSE(point.curvature);
  EXPECT_FALSE(point.residualPx);
}

TEST(ExplainedPixel, OfNothing) {
  const ExplainedPixel pixel = explained(looking());
  EXPECT_TRUE(pixel.points.empty());
  EXPECT_EQ(pixel.color, Vec3(0.1, 0.2, 0.3));
  EXPECT_TRUE(pixel.certified);
}

// The same colours as the reference's picture, of a light with a radius, too.
TEST(ExplainedPixel, IsThePictures) {
  Scene scene = looking();
  scene.add(Node{.surface = torus(2, 0.7), .material = scene.add(Material{.diffuse = {0.2, 0.5, 0.7}})});
  const NodeId floor = scene.add(Node{.translation = Vec3(0, -1, 0), .surface = rectangle(9, 9)});
  scene.add(
      Node{.translation = Vec3(1, 5, 2),
           .light = Light{.shadow = Light::Shadow::Exact, .radius = 0.5, .casters = {NodeId{0}, floor}}});
  const Snapshot snapshot = takeSnapshot(scene, 0, kExplainedSize);
  const ReferencePicture picture = castPicture(snapshot);
  for (int i = 0; i < 24; ++i) {
    const int x = (i * 29) % kExplainedSize.width, y = (i * 17) % kExplainedSize.height;
    const ExplainedPixel pixel = explainPixel(snapshot, {x + 0.5, y + 0.5});
    for (int c = 0; c < 3; ++c) EXPECT_EQ(float(pixel.color[c]), picture.color.pixel(x, y)[std::size_t(c)]);
    if (pixel.points.empty()) continue;
    const std::size_t at = std::size_t(y) * kExplainedSize.width + std::size_t(x);
    EXPECT_EQ(snapshot.nodes[pixel.points[0].node].number, picture.number[at]);
    EXPECT_EQ(pixel.points[0].depth, picture.depth[at]);
    EXPECT_EQ(pixel.points[0].lights.size(), 1U);
    EXPECT_EQ(pixel.points[0].lights[0].points, 16U);
    expectNear(pixel.points[0].reflected, pixel.color, 1e-12);
  }
}

}  // namespace
}  // namespace luxo
