// SPDX-License-Identifier: Apache-2.0
// What rays find of all that is seen through in a pixel: of balls on the view's axis, whose points are known.
#include "draw/ray_layers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "reference/caster.h"
#include "unit/scene_test_support.h"

namespace luxo {
namespace {

constexpr PixelSize kBallSize{32, 32};
constexpr PixelPlace kBallMiddle{16, 16};

/// A ball of glass around the origin, seen from (0, 0, 5) along -z, and what it is drawn with.
struct GlassBall {
  Scene scene;
  MaterialId glass = scene.add(Material{.name = "glass", .opacity = 0.5, .twoSided = TwoSided::Yes});
  RayDraws draws;

  explicit GlassBall(double radius = 1) {
    add(radius);
    draws.origin = Vec3(0, 0, 5);
  }

  void add(double radius) {
    const auto node = static_cast<std::uint32_t>(draws.layers.size());
    scene.add(Node{.surface = sphere(radius), .material = glass});
    draws.layers.push_back({.node = node, .material = 7 + node});
  }

  void light(const Vec3& at) {
    scene.add(Node{.translation = at, .light = Light{.shadow = Light::Shadow::Exact}});
    draws.groups.resize(1);
    draws.groups[0].lights = {0U};
  }

  /// Along the axis.
  [[nodiscard]] RayPoints points(const Doubt& doubt = {
                                     .pixel = kBallMiddle, .point = false, .layers = true}) {
    const Snapshot snapshot = takeSnapshot(scene, 0, kBallSize, Camera{.eye = Vec3(0, 0, 5)});
    const reference::Caster caster(snapshot);
    const LayerRays rays(caster, draws);
    RayPoints found;
    rays.append(rays.look(caster.rayThrough(16, 16), doubt), kBallMiddle, found);
    return found;
  }
};

TEST(LayerRays, FindTheFrontAndTheBackOfABall) {
  const RayPoints found = GlassBall().points();
  ASSERT_EQ(found.layerPoints.size(), 2U);
  EXPECT_NEAR(found.layerPoints[0].depth, 4, 1e-6);
  EXPECT_NEAR(found.layerPoints[1].depth, 6, 1e-6);
  EXPECT_EQ(found.layersUndecided, 0U);
  for (const shared::LayerPoint& point : found.layerPoints) {
    EXPECT_EQ(point.material, 7U | shared::kLayerByRay);
    // (0, 0, 1): both turn toward the viewer.
    EXPECT_NEAR(point.normal.x, 0, 1e-6);
    EXPECT_NEAR(point.normal.y, 0, 1e-6);
  }
  // A triangle for the pixel, which tells the range of its points.
  ASSERT_EQ(found.layers.size(), 3U);
  for (const RayLayers& vertex : found.layers) {
    EXPECT_EQ(vertex.place, Vec2f(16.5f, 16.5f));
    EXPECT_EQ(vertex.first, 0U);
    EXPECT_EQ(vertex.count, 2U);
    EXPECT_EQ(vertex.ofMeshes, 0U);
  }
}

// Nearer to each other than two floats at their depth: still in the order in which the ray comes upon them.
TEST(LayerRays, KeepTheOrderThatRoundingWouldLose) {
  GlassBall balls;
  balls.add(1 - 1e-8);
  const RayPoints found = balls.points();
  ASSERT_EQ(found.layerPoints.size(), 4U);
  ASSERT_EQ(static_cast<float>(5 - 1.0), static_cast<float>(5 - (1 - 1e-8))) << "the test has a point";
  const auto materialOf = [&](std::size_t i) {
    return found.layerPoints[i].material & shared::kLayerMaterial;
  };
  EXPECT_EQ((std::vector{materialOf(0), materialOf(1), materialOf(2), materialOf(3)}),
            (std::vector{7U, 8U, 8U, 7U}));
  for (std::size_t i = 1; i < 4; ++i)
    EXPECT_GT(found.layerPoints[i].depth, found.layerPoints[i - 1].depth) << i;
  EXPECT_EQ(found.layerPoints[1].depth, std::nextafter(found.layerPoints[0].depth, 10.0f));
}

// An opaque wall behind the light keeps none of it from the ball; one between them all of it.
TEST(LayerRays, TellWhichLightReachesThem) {
  const auto shadowsWithWallAt = [](double z) {
    GlassBall ball;
    ball.light(Vec3(0, 20, 5));
    // Parallel to the floor, between the ball and the light, or beyond that.
    ball.scene.add(Node{.translation = Vec3(0, z, 0), .surface = rectangle(100, 100)});
    const RayPoints found = ball.points();
    EXPECT_EQ(found.layerPoints.size(), 2U);
    EXPECT_EQ(found.layerLights.size(), 2U) << "of each point, of one group";
    return found.layerLights.at(0).shadows;
  };
  EXPECT_EQ(shadowsWithWallAt(10), 1U);
  EXPECT_EQ(shadowsWithWallAt(30), 0U);
}

// Which points of meshes there are no ray tells.
TEST(LayerRays, AreNotCertainOfMeshesThatNobodyHasTold) {
  GlassBall ball;
  ball.draws.layerMeshes.push_back({.node = 0, .material = 9});
  EXPECT_EQ(ball.points().layersUndecided, 1U);
  Doubt told{.pixel = kBallMiddle, .point = false, .layers = true};
  told.meshes.emplace();
  EXPECT_EQ(ball.points(told).layersUndecided, 0U) << "told that there are none";
}

}  // namespace
}  // namespace luxo
