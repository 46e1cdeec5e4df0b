// SPDX-License-Identifier: Apache-2.0
// Ambient occlusion by what the picture shows, against form factors that are known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "base/error.h"
#include "reference/reference.h"
#include "support/picture.h"
#include "surface/library.h"
#include "surface/teapot.h"

namespace luxo::test {
namespace {

constexpr PixelSize kOpennessSize{160, 120};
constexpr double kOpenLight = 0.8;

class OpennessTest : public PictureTest {
 protected:
  /// How open the sky is in each pixel: of white under ambient light alone.
  Image openness(Scene& scene, double radius, const DrawOptions& options = {}) {
    RenderSettings settings = plainSettings();
    settings.ambientOcclusion = {.radius = radius};
    settings.ambient = Vec3(kOpenLight);
    scene.set(settings);
    return draw(scene, camera_, kOpennessSize, options).image;
  }

  Camera camera_{.eye = Vec3(1, 3, 5), .lookAt = Vec3(0, 0, -0.5), .fovY = radians(40), .near = 0.1};
};

Scene floored() {
  Scene scene;
  const MaterialId white =
      scene.add(Material{.diffuse = Vec3(1), .specular = Vec3(0), .twoSided = TwoSided::Yes});
  scene.add(Node{.name = "floor", .surface = rectangle(40, 40), .material = white});
  return scene;
}

// A direction w meets a wall at a distance d within the radius if its part toward it is at least d / radius:
// a segment of the disc that the cosine makes of the half sphere.
double besideWall(double distance, double radius) {
  const double c = std::clamp(distance / radius, 0.0, 1.0);
  return 1 - (std::acos(c) - c * std::sqrt(1 - c * c)) / kPi;
}

TEST_F(OpennessTest, OfAFloorIsOneFromEverywhere) {
  Scene scene = floored();
  for (const Vec3& eye : {Vec3(1, 3, 5), Vec3(0, 0.4, 6), Vec3(0.1, 9, 0)}) {
    camera_.eye = eye;
    const Image image = openness(scene, 1.5);
    for (int y = kOpennessSize.height - 20; y < kOpennessSize.height; ++y)
      for (int x = 0; x < kOpennessSize.width; ++x)
        // 16 slices stand for an integral of what is smooth; single precision puts points beside their plane.
        // Measured at most 5e-6.
        ASSERT_NEAR(colorAt(image, x, y).x / kOpenLight, 1, 2e-5) << x << " " << y;
  }
}

TEST_F(OpennessTest, WhereAFloorMeetsAWallIsWhatIsKnown) {
  Scene scene = floored();
  const MaterialId white =
      scene.add(Material{.diffuse = Vec3(1), .specular = Vec3(0), .twoSided = TwoSided::Yes});
  scene.add(plate(Vec3(0, 10, -2), {40, 20}, white));
  const double radius = 1;
  const Image image = openness(scene, radius);
  const CameraModel model(camera_, kOpennessSize);
  double squares = 0, largest = 0;
  int near = 0;
  for (int y = 0; y < kOpennessSize.height; ++y)
    for (int x = 20; x < kOpennessSize.width - 20; ++x) {
      const Ray ray = model.through(centerOf(x, y));
      const auto onFloor = hitPlane(ray, Vec3(0), Vec3(0, 1, 0)),
                 onWall = hitPlane(ray, Vec3(0, 0, -2), Vec3(0, 0, 1));
      const bool isFloor = onFloor && *onFloor > 0 && (!onWall || *onWall <= 0 || *onFloor < *onWall);
      const Vec3 point = ray.at(isFloor ? *onFloor : *onWall);
      const double distance = isFloor ? point.z + 2 : point.y;
      const double off = colorAt(image, x, y).x / kOpenLight - besideWall(distance, radius);
      near += distance < radius;
      squares += distance < radius ? off * off : 0;
      largest = std::max(largest, std::abs(off));
    }
  ASSERT_GT(near, 2000);
  // Measured 0.030 and 0.13, in the crease, where a pixel is a tenth of the radius.
  EXPECT_LT(std::sqrt(squares / near), 0.04);
  EXPECT_LT(largest, 0.17);
}

// What is nearer to the eye than by the radius has no dark halo around it.
TEST_F(OpennessTest, WhatIsFarInFrontLeavesNoHalo) {
  Scene scene = floored();
  const Image alone = openness(scene, 0.5);
  const MaterialId white = scene.add(Material{.diffuse = Vec3(1), .specular = Vec3(0)});
  scene.add(
      Node{.name = "ball", .translation = Vec3(0.5, 1.7, 2), .surface = sphere(0.4), .material = white});
  const Image behind = openness(scene, 0.5);
  const CameraModel model(camera_, kOpennessSize);
  int same = 0;
  for (int y = 0; y < kOpennessSize.height; ++y)
    for (int x = 0; x < kOpennessSize.width; ++x) {
      if (hitSphere(model.through(centerOf(x, y)), Vec3(0.5, 1.7, 2), 0.4)) continue;
      // But for what positions are relative to.
      ASSERT_TRUE(near(colorAt(alone, x, y), colorAt(behind, x, y), 1e-6)) << x << " " << y;
      ++same;
    }
  EXPECT_GT(same, 15000);
}

/// The openness of a floor of that material, beside a wall that is opaque.
TEST_F(OpennessTest, OfWhatIsCutOutOrSeenThroughIsThatOfWhatIsOpaque) {
  const auto besideWall = [&](Material material, Shading shading) {
    Scene scene;
    const MaterialId ground = scene.add(std::move(material));
    scene.add(Node{.name = "floor", .surface = rectangle(40, 40), .material = ground});
    scene.add(plate(Vec3(0, 10, -2), {40, 20}, scene.add(Material{.diffuse = Vec3(1), .specular = Vec3(0)})));
    return openness(scene, 1, {.shading = shading});
  };
  const Material white{.diffuse = Vec3(1), .specular = Vec3(0), .twoSided = TwoSided::Yes};
  TextureMap map{.texture = std::make_shared<const Texture>(
                     makeTexture(Image(2, 2, 3, {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1}), "white"))};
  Material cut = white, glass = white;
  cut.map = map;
  cut.mapOpacity = true;
  cut.cutoff = 0.5;
  glass.opacity = 0.75;
  for (const Shading shading : {Shading::Exact, Shading::Phong, Shading::Flat}) {
    const Image opaque = besideWall(white, shading), cutOut = besideWall(cut, shading),
                through = besideWall(glass, shading);
    double darkest = 1, largest = 0, largestThrough = 0;
    int compared = 0;
    for (int y = 0; y < kOpennessSize.height; ++y)
      for (int x = 0; x < kOpennessSize.width; ++x) {
        const auto onFloor =
            hitPlane(CameraModel(camera_, kOpennessSize).through(centerOf(x, y)), Vec3(0), Vec3(0, 1, 0));
        const Ray ray = CameraModel(camera_, kOpennessSize).through(centerOf(x, y));
        // Its own far parts are no part of the picture that tells the openness; near the wall's foot that
        // wall is.
        if (!onFloor || ray.at(*onFloor).z < -1.9) continue;
        const double value = colorAt(opaque, x, y).x;
        darkest = std::min(darkest, value / kOpenLight);
        largest = std::max(largest, std::abs(colorAt(cutOut, x, y).x - value));
        // A quarter of the black behind comes through.
        largestThrough = std::max(largestThrough, std::abs(colorAt(through, x, y).x / 0.75 - value));
        ++compared;
      }
    EXPECT_GT(compared, 8000);
    EXPECT_LT(darkest, 0.7);
    EXPECT_LT(largest, 0.01) << nameOf(shading);
    EXPECT_LT(largestThrough, 0.01) << nameOf(shading);
  }
}

TEST_F(OpennessTest, OffCostsNothing) {
  Scene scene = floored();
  int drawn = 0;
  const auto passes = [&](double radius, double ambient) {
    RenderSettings settings = plainSettings(Vec3(0.01 * ++drawn));  // else the picture before is shown again
    settings.ambientOcclusion = {.radius = radius};
    settings.ambient = Vec3(ambient);
    scene.set(settings);
    return draw(scene, camera_, kOpennessSize).statistics.count.passes;
  };
  const std::uint64_t usual = passes(0, 1);
  EXPECT_EQ(passes(1, 0), usual);
  EXPECT_GT(passes(1, 1), usual);
}

TEST_F(OpennessTest, IsTheSameOfEverySampleAndInPhongShading) {
  Scene scene = floored();
  const MaterialId white = scene.add(Material{.diffuse = Vec3(1), .specular = Vec3(0)});
  scene.add(Node{.name = "ball", .translation = Vec3(0, 0.5, 0), .surface = sphere(0.5), .material = white});
  const Image one = openness(scene, 1), four = openness(scene, 1, {.samples = 4}),
              phong = openness(scene, 1, {.shading = Shading::Phong});
  double darkest = 1, samples = 0, shading = 0;
  for (int y = 0; y < kOpennessSize.height; ++y)
    for (int x = 0; x < kOpennessSize.width; ++x) {
      const double value = colorAt(one, x, y).x / kOpenLight;
      darkest = std::min(darkest, value);
      samples += std::abs(value - colorAt(four, x, y).x / kOpenLight);
      shading += std::abs(value - colorAt(phong, x, y).x / kOpenLight);
    }
  EXPECT_LT(darkest, 0.5);
  // Of the mean: pixels on edges, and in the contact's shade, differ.
  EXPECT_LT(samples / (kOpennessSize.width * kOpennessSize.height), 5e-3);
  EXPECT_LT(shading / (kOpennessSize.width * kOpennessSize.height), 5e-3);
}

/// What the picture does not show occludes, too: a part of the error that no number of steps takes away.
TEST_F(OpennessTest, OfBodiesIsNearThatOfTheReferencesRays) {
  Scene scene = floored();
  const MaterialId white =
      scene.add(Material{.diffuse = Vec3(1), .specular = Vec3(0), .twoSided = TwoSided::Yes});
  scene.add(
      Node{.translation = Vec3(-0.9, 0, -0.3), .scale = Vec3(0.35), .surface = teapot(), .material = white});
  scene.add(Node{.translation = Vec3(0.9, 0.5, 0), .surface = sphere(0.5), .material = white});
  scene.add(Node{.translation = Vec3(0.1, 0.2, 0.9), .surface = torus(0.4, 0.2), .material = white});
  const Image screen = openness(scene, 1);
  const ReferencePicture rays = castPicture(takeSnapshot(scene, 0, kOpennessSize, camera_));
  double squares = 0, darkest = 1;
  int seen = 0;
  for (int y = 0; y < kOpennessSize.height; ++y)
    for (int x = 0; x < kOpennessSize.width; ++x) {
      if (rays.number[static_cast<std::size_t>(y * kOpennessSize.width + x)] == 0) continue;
      const double truth = rays.color.pixel(x, y)[0] / kOpenLight;
      const double off = colorAt(screen, x, y).x / kOpenLight - truth;
      squares += off * off;
      darkest = std::min(darkest, truth);
      ++seen;
    }
  EXPECT_GT(seen, 10000);
  EXPECT_LT(darkest, 0.2);
  EXPECT_LT(std::sqrt(squares / seen), 0.06);
}

TEST_F(OpennessTest, ByRaysIsTheReferences) {
  Scene scene = floored();
  RenderSettings settings = plainSettings();
  settings.ambientOcclusion = {.method = OcclusionMethod::Rays, .radius = 1};
  scene.set(settings);
  EXPECT_THROW(static_cast<void>(draw(scene, camera_, kOpennessSize)), Error);
}

}  // namespace
}  // namespace luxo::test
