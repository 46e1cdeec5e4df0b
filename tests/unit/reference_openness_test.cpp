// SPDX-License-Identifier: Apache-2.0
// How much of the ambient light the reference lets to a point, against form factors that are known.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <utility>

#include "image/texture.h"
#include "reference/caster.h"
#include "surface/library.h"
#include "unit/scene_test_support.h"

namespace luxo {
namespace {

constexpr PixelSize kOpenSize{32, 32};
// 256 evenly spread points tell the area of a half disc, or of a disc in the disc, to a few parts in 256.
constexpr double kOfRays = 4.0 / reference::kOpennessRays;

/// Of the point in the middle of the picture, at which the eye looks from above.
double opennessOf(Scene scene, double radius, const Vec3& point = Vec3(0)) {
  scene.set(RenderSettings{.size = kOpenSize, .ambient = Vec3(1), .ambientOcclusion = {.radius = radius}});
  const Camera camera{.eye = point + Vec3(0, 0.25, 0), .lookAt = point, .up = Vec3(0, 0, -1), .near = 1e-3};
  const Snapshot snapshot = takeSnapshot(scene, 0, kOpenSize, camera);
  const reference::Caster caster(snapshot);
  const auto sight = caster.look(caster.rayThrough(16, 16));
  return sight.hits.empty() ? -1 : caster.openness(sight.hits.front());
}

/// A floor of that size around the origin.
Scene floored(double size) {
  Scene scene;
  scene.add(Node{.name = "floor", .surface = rectangle(size, size)});
  return scene;
}

TEST(Openness, OfAFloorIsOne) { EXPECT_EQ(opennessOf(floored(20), 5), 1); }

// Of a square with half the side a, seen from a small piece of a plane below its middle and parallel to it,
// at distance 1: four times that of the rectangle above one corner (e.g. Howell's catalogue, B-4).
double formFactorOfSquare(double a) {
  return 4 * 2 / kTau * 2 * (a / std::sqrt(1 + a * a) * std::atan(a / std::sqrt(1 + a * a))) / 2;
}

// A direction w, of length 1, meets a wall x = d within the radius if its x is at least d / radius: over the
// unit disc, which is what the cosine makes of the half sphere, that is a segment.
TEST(Openness, BesideAWallIsASegmentOfADisc) {
  Scene scene = floored(20);
  scene.add(Node{.name = "wall",
                 .translation = Vec3(1, 0, 0),
                 .rotation = Rotation{{0, 0, 1}, radians(90)},
                 .surface = rectangle(100, 100)});
  for (const double radius : {0.5, 1.25, 2.0, 5.0, 40.0}) {
    const double c = std::min(1 / radius, 1.0);
    const double segment = (std::acos(c) - c * std::sqrt(1 - c * c)) / kPi;
    EXPECT_NEAR(opennessOf(scene, radius), 1 - segment, kOfRays) << radius;
  }
}

// The form factor of a ball of radius r above a small piece of a plane, at height h: (r / h)^2.
TEST(Openness, UnderABallIsItsFormFactor) {
  Scene scene = floored(20);
  scene.add(Node{.name = "ball", .translation = Vec3(0, 2, 0), .surface = sphere(1)});
  EXPECT_NEAR(opennessOf(scene, 50), 1 - 0.25, kOfRays);
  EXPECT_EQ(opennessOf(scene, 0.99), 1);
}

// Of a box without a lid the floor's middle sees the opening alone, and of that what the ball leaves.
TEST(Openness, InABoxWithABallIsWhatTheBallLeavesOfTheOpening) {
  for (const double half : {1.0, 1.5}) {
    Scene scene = floored(2 * half);
    for (int side = 0; side < 4; ++side) {
      const double angle = 0.25 * kTau * side;
      const Vec3 out(std::cos(angle), 0, std::sin(angle));
      scene.add(Node{.name = "wall",
                     .translation = half * out + Vec3(0, 0.5, 0),
                     .rotation = Rotation{{-out.z, 0, out.x}, radians(90)},
                     .surface = rectangle(side % 2 == 0 ? 1 : 2 * half, side % 2 == 0 ? 2 * half : 1)});
    }
    EXPECT_NEAR(opennessOf(scene, 50), formFactorOfSquare(half), 2 * kOfRays) << half;
    scene.add(Node{.name = "ball", .translation = Vec3(0, 0.6, 0), .surface = sphere(0.25)});
    const double ball = 0.25 / 0.6;
    EXPECT_NEAR(opennessOf(scene, 50), formFactorOfSquare(half) - ball * ball, 3 * kOfRays) << half;
  }
}

TEST(Openness, InsideIsDarkAndGlassOccludesNothing) {
  Scene scene = floored(2);
  scene.add(Node{.name = "around", .surface = sphere(3)});
  EXPECT_EQ(opennessOf(scene, 7), 0);

  Scene glass = floored(2);
  const MaterialId clear = glass.add(Material{.name = "glass", .opacity = 0.5});
  glass.add(Node{.name = "around", .surface = sphere(3), .material = clear});
  EXPECT_EQ(opennessOf(glass, 7), 1);
}

}  // namespace
/// White, and cut out by an image of 3 x 3 texels with that alpha in the middle and the other around it.
Material cutOutWindow(double middle, double around) {
  Image image(3, 3, 4);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 3; ++x)
      for (int c = 0; c < 4; ++c)
        image.pixel(x, y)[std::size_t(c)] = c < 3 ? 1.0f : float(x == 1 && y == 1 ? middle : around);
  TextureMap map{.texture = std::make_shared<const Texture>(makeTexture(image, "window"))};
  map.filter = TextureFilter::Nearest;
  return {.name = "window", .map = map, .mapOpacity = true, .cutoff = 0.5};
}

// Light comes through the hole alone, or past the pane alone.
TEST(Openness, BelowACutOutCeilingIsTheFormFactorOfItsHole) {
  for (const double half : {0.25, 0.5, 1.0, 2.0})
    for (const bool hole : {true, false}) {
      Scene scene = floored(2);
      const MaterialId window = scene.add(cutOutWindow(hole ? 0.2 : 0.8, hole ? 0.8 : 0.2));
      scene.add(Node{.name = "ceiling",
                     .translation = Vec3(0, 1, 0),
                     .surface = rectangle(6 * half, 6 * half),
                     .material = window});
      const double square = formFactorOfSquare(half), whole = formFactorOfSquare(3 * half);
      EXPECT_NEAR(opennessOf(scene, 50), hole ? 1 - (whole - square) : 1 - square, 3 * kOfRays)
          << half << " " << hole;
    }
}

TEST(Openness, OfWhatIsCutOutOrSeenThroughIsThatOfWhatIsOpaque) {
  const auto besideWall = [](Material material) {
    Scene scene;
    const MaterialId ground = scene.add(std::move(material));
    scene.add(Node{.name = "floor", .surface = rectangle(20, 20), .material = ground});
    scene.add(Node{.name = "wall",
                   .translation = Vec3(1, 0, 0),
                   .rotation = Rotation{{0, 0, 1}, radians(90)},
                   .surface = rectangle(100, 100)});
    return opennessOf(scene, 2);
  };
  const double opaque = besideWall({.name = "plain"});
  EXPECT_LT(opaque, 0.9);
  EXPECT_EQ(besideWall(cutOutWindow(0.8, 0.8)), opaque);
  EXPECT_EQ(besideWall({.name = "glass", .opacity = 0.5}), opaque);
}

}  // namespace luxo
