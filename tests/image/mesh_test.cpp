// SPDX-License-Identifier: Apache-2.0
// Pictures of triangle meshes: against the ground truth in every pixel, and against what is known of them.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <random>
#include <vector>

#include "mesh/index_windows.h"
#include "support/meshes.h"
#include "support/verified_picture.h"
#include "surface/library.h"

namespace luxo::test {
namespace {

class MeshPicture : public VerifiedPictureTest {
 protected:
  /// Every pixel: nothing lost, what is shown is the triangle that the pixel's ray meets, there.
  void expectExact(const Snapshot& snapshot, std::uint64_t pixels) {
    const Verified found = verified(snapshot);
    const Verification& v = found.verification;
    EXPECT_EQ(found.statistics.error.unconvergedPx, 0U);
    EXPECT_EQ(found.statistics.error.uncertifiedPx, 0U);
    EXPECT_EQ(found.statistics.error.boundPx, 0);
    EXPECT_GE(v.coverage.both, pixels);
    EXPECT_EQ(v.wrong.total(), 0U) << v.wrong.hitMiss << " hit or miss, " << v.wrong.layer << " layer, "
                                   << v.wrong.point << " point, " << v.wrong.light << " light";
    EXPECT_EQ(v.nanPixels, 0U);
  }
};

/// A camera that sees the cube from -1 to 1.
Camera cameraFrom(const Vec3& direction, const Vec3& middle = Vec3(0)) {
  return {.eye = middle + 4.5 * unit(direction), .lookAt = middle};
}

Scene sceneOf(Surface surface, Material material = {}) {
  Scene scene;
  scene.add(Node{.surface = std::move(surface), .material = scene.add(std::move(material))});
  scene.add(Node{.translation = Vec3(3, 5, 4), .light = Light{.intensity = 0.9}});
  return scene;
}

TEST_F(MeshPicture, EveryPixelIsTheTrianglesOwnPoint) {
  std::mt19937 random(1);
  const std::array<TriangleMesh, 5> meshes = {quadMesh(), cubeMesh(), icosphere(3),
                                              meshOf(torus(0.7, 0.25), 1e-3), soup(random, 150, 0.4)};
  for (const TriangleMesh& mesh : meshes) {
    SCOPED_TRACE(mesh.name());
    const Scene scene = sceneOf(mesh);
    expectExact(takeSnapshot(scene, 0, {160, 120}, cameraFrom({1, 0.8, 1.5})), 1500);
    Camera parallel = cameraFrom({-1, 0.4, 0.7});
    parallel.projection = Projection::Orthographic;
    parallel.height = 0.17;
    expectExact(takeSnapshot(scene, 0, {160, 120}, parallel), 1500);
  }
}

// What floats leave of corners and of what is interpolated between them is more than a point may be off
// there, and less than sends the picture to rays.
TEST_F(MeshPicture, FromAsNearAsFloatsAllowThePointsAreTheRays) {
  std::mt19937 random(5);
  std::uint64_t byRays = 0, pixels = 0;
  for (const TriangleMesh& mesh : {quadMesh(), cubeMesh(), icosphere(1)})
    for (int i = 0; i < 10; ++i) {
      SCOPED_TRACE(mesh.name() + " " + std::to_string(i));
      std::uniform_real_distribution<double> any(-1, 1);
      Camera parallel =
          cameraFrom({any(random), any(random), 1.5}, {0.1 * any(random), 0.1 * any(random), 0});
      parallel.projection = Projection::Orthographic;
      parallel.height = 0.17;
      const Snapshot snapshot = takeSnapshot(sceneOf(mesh), 0, {160, 120}, parallel);
      expectExact(snapshot, 1500);
      byRays += renderer().render(snapshot, {}).statistics.error.resolvedByRaysPx;
      pixels += 160 * 120;
    }
  EXPECT_LT(byRays, pixels / 2);
}

// What floats leave of corners that are near to the eye is as little as they are far, however large the mesh.
TEST_F(MeshPicture, FromNearAFineMeshNoPixelNeedsARay) {
  const Scene scene = sceneOf(icosphere(6));
  for (const double distance : {1.3, 1.05, 1.02}) {
    SCOPED_TRACE(distance);
    const Vec3 out = unit(Vec3(1, 0.8, 1.5));
    const Snapshot snapshot = takeSnapshot(
        scene, 0, {320, 240}, {.eye = distance * out, .lookAt = Vec3(0.3, 0.9, 0.2), .near = 1e-3});
    EXPECT_EQ(renderer().render(snapshot, {}).statistics.error.resolvedByRaysPx, 0U);
    expectExact(snapshot, 5000);
  }
}

/// Every other cell of a grid in the plane y = 0, from a corner on.
void addChecks(MeshArrays& arrays, double x, double z, double cell, int count) {
  for (int i = 0; i < count; ++i)
    for (int j = i % 2; j < count; j += 2) {
      const auto first = std::uint32_t(arrays.positions.size());
      const double left = x + cell * i, back = z + cell * j;
      arrays.positions.insert(
          arrays.positions.end(),
          {{left, 0, back}, {left, 0, back + cell}, {left + cell, 0, back + cell}, {left + cell, 0, back}});
      for (const std::uint32_t corner : {0, 1, 2, 0, 2, 3}) arrays.indices.push_back(first + corner);
    }
}

// Long edges of what is flat are clipped, and the corners that this makes are floats from their middle, which
// may be kilometres away.
TEST_F(MeshPicture, OfAFloorThatIsClippedItsNearEdgesAreTheTrianglesOwn) {
  MeshArrays arrays;
  addChecks(arrays, -40, -40, 2, 40);
  addChecks(arrays, 20000, 8000, 20, 100);
  Scene scene = sceneOf(triangleMesh(std::move(arrays), "floor"));
  for (const double turn : {0.1, 0.7, 1.3})
    expectExact(
        takeSnapshot(scene, 0, {320, 240},
                     {.eye = Vec3(0.3, 0.6, 0.2),
                      .lookAt = Vec3(0.3 + 5 * std::cos(0.02 * turn), 0.25, 0.2 + 5 * std::sin(0.02 * turn)),
                      .fovY = radians(13.7),
                      .near = 0.1}),
        5000);
}

// Its vertices are more than 16 bits number: it is drawn window by window (mesh/index_windows.h).
TEST_F(MeshPicture, OfMoreVerticesThan16BitsNumberIsTheTrianglesOwnPoint) {
  const TriangleMesh ball = icosphere(7);
  ASSERT_GT(ball.positions().size(), 2 * kWindowVertices);
  const Scene scene = sceneOf(ball);
  const Snapshot whole = takeSnapshot(scene, 0, {160, 120}, cameraFrom({1, 0.8, 1.5}));
  expectExact(whole, 1500);
  DrawOptions options{.shading = Shading::Phong, .skips = Skips::none()};
  const FrameCounts all = renderer().render(whole, options).statistics.count;
  EXPECT_EQ(all.drawCalls, 3U);
  EXPECT_EQ(all.triangles, ball.triangleCount());
  // Clusters in the picture are of all windows.
  Camera near = cameraFrom({1, 0.8, 1.5});
  near.fovY = radians(4.0);
  expectExact(takeSnapshot(scene, 0, {160, 120}, near), 15000);
}

// A pixel is 2e-5 of how far away they are: of a distance from the eye floats leave a hundredth of it.
TEST_F(MeshPicture, ThroughATelescopeThePointsAreTheRays) {
  Scene scene = sceneOf(icosphere(2));
  scene.add(Node{.translation = Vec3(0, -1, 0), .surface = rectangle(12, 12)});
  for (const Vec3& from : {Vec3(67.5, 36.9, 69), Vec3(-120, 20, 11), Vec3(30, 900, 200)}) {
    const Camera camera{.eye = from, .lookAt = Vec3(0.05, 0.1, -0.02), .fovY = 6e-4};
    expectExact(takeSnapshot(scene, 0, {96, 72}, camera), 1500);
  }
}

TEST_F(MeshPicture, MirroredTurnedAndFarFromTheOriginItIsTheSame) {
  std::mt19937 random(2);
  for (const Vec3& place : {Vec3(0), Vec3(5e5, -3e5, 2e5)}) {
    Scene scene;
    scene.add(Node{.translation = place + Vec3(-0.6, 0, 0),
                   .rotation = Rotation{{1, 2, 0}, 0.7},
                   .scale = Vec3(-0.5, 0.8, 0.6),
                   .surface = icosphere(2)});
    scene.add(
        Node{.translation = place + Vec3(0.5, 0, 0), .scale = Vec3(0.6), .surface = soup(random, 60, 0.5)});
    scene.add(Node{.translation = place + Vec3(0, 0.1, 0), .surface = torus(0.9, 0.1)});
    scene.add(Node{.translation = place + Vec3(3, 5, 4), .light = Light{}});
    expectExact(takeSnapshot(scene, 0, {160, 120}, cameraFrom({1, 0.8, 1.5}, place)), 2000);
  }
}

/// A mesh over a floor, a formula's ring around it, and a soup beside it, under two lights with exact
/// shadows.
Scene shadowScene(std::mt19937& random) {
  Scene scene;
  scene.add(Node{.name = "floor", .translation = Vec3(0, -1, 0), .surface = rectangle(8, 8)});
  scene.add(Node{.translation = Vec3(-0.5, 0, 0),
                 .rotation = Rotation{{1, 2, 0}, 0.7},
                 .scale = Vec3(0.6),
                 .surface = icosphere(2)});
  scene.add(Node{
      .translation = Vec3(0.8, -0.3, 0.3), .scale = Vec3(-0.7, 0.7, 0.7), .surface = soup(random, 40, 0.5)});
  scene.add(Node{
      .translation = Vec3(0.2, 0.2, 0), .rotation = Rotation{{1, 0, 1}, 0.5}, .surface = torus(1.1, 0.08)});
  scene.add(
      Node{.translation = Vec3(2, 4, 3), .light = Light{.intensity = 0.6, .shadow = Light::Shadow::Exact}});
  scene.add(Node{
      .rotation = Rotation{{1, 0.4, 0}, -0.9},
      .light = Light{.type = Light::Type::Directional, .intensity = 0.4, .shadow = Light::Shadow::Exact}});
  return scene;
}

TEST_F(MeshPicture, CastsExactShadowsOnItselfAndOthersAndReceivesThem) {
  std::mt19937 random(3);
  const Snapshot snapshot = takeSnapshot(shadowScene(random), 0, {160, 120}, cameraFrom({1, 0.8, 1.5}));
  expectExact(snapshot, 10000);
  // A shader finds them, and leaves some pixels to rays.
  const Picture picture = renderer().render(snapshot, {});
  EXPECT_LT(picture.statistics.error.shadowRaysPx, 160 * 120 / 8);
  EXPECT_GT(picture.statistics.count.shadowPasses, 4U);
}

// Devices draw triangles up to 1/256 pixel beyond their edges, and there a point is behind the facet that
// goes on.
TEST_F(MeshPicture, NoPointIsInTheShadowOfTheFacetThatGoesOnThere) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(-1, 1);
  const TriangleMesh sheet =
      meshOf(surface([](auto u, auto v) { return point(u, 0.3 * sin(4 * u) * cos(5 * v), v); },
                     {{-1.5, 1.5}, {-1.5, 1.5}}),
             0.05);
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    Scene scene;
    scene.add(Node{.surface = sheet});
    scene.add(Node{.translation = Vec3(3 * any(random), 2.5, 3 * any(random)),
                   .light = Light{.intensity = 0.9, .shadow = Light::Shadow::Exact}});
    expectExact(takeSnapshot(scene, 0, {48, 36}, cameraFrom({any(random), 0.6, any(random)})), 300);
  }
}

TEST_F(MeshPicture, SeenThroughItIsBlendedInTheOrderOfItsDepth) {
  std::mt19937 random(4);
  Scene scene;
  const MaterialId glass = scene.add(Material{.diffuse = {0.2, 0.5, 0.9}, .opacity = 0.4});
  scene.add(Node{.translation = Vec3(0, -1, 0), .surface = rectangle(8, 8)});
  scene.add(
      Node{.translation = Vec3(-0.4, 0, 0), .scale = Vec3(0.8), .surface = icosphere(2), .material = glass});
  scene.add(Node{.scale = Vec3(0.8), .surface = soup(random, 40, 0.5), .material = glass});
  scene.add(Node{.surface = torus(0.9, 0.2), .material = glass});
  scene.add(Node{.translation = Vec3(2, 4, 3), .light = Light{}});
  const Verified found = verified(takeSnapshot(scene, 0, {120, 90}, cameraFrom({1, 0.8, 1.5})));
  EXPECT_EQ(found.statistics.error.unconvergedPx, 0U);
  EXPECT_EQ(found.verification.wrong.total(), 0U);
  EXPECT_GT(found.statistics.count.layerPoints, 4000U);
}

}  // namespace
}  // namespace luxo::test
