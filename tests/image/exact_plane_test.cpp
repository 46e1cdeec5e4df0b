// SPDX-License-Identifier: Apache-2.0
// Planes, which pixels find without a search: out to the horizon, along their edges, from both sides and from
// within.
#include <gtest/gtest.h>

#include <cmath>

#include "math/sampling.h"
#include "support/verified_picture.h"
#include "surface/catalogue.h"

namespace luxo::test {
namespace {

class ExactPlane : public VerifiedPictureTest {
 protected:
  /// As right as (u, v) can be in float, which on large planes is worse than a thousandth of a pixel.
  Verified expectAsRightAsFloats(const Scene& scene, PixelSize size, std::uint64_t pixels) {
    Verified found = verified(takeSnapshot(scene, 0, size));
    EXPECT_EQ(found.statistics.error.unconvergedPx, 0U);
    EXPECT_LE(found.statistics.error.residualMaxPx.value_or(1), 1e-4);
    EXPECT_GE(found.verification.coverage.both, pixels);
    EXPECT_EQ(found.verification.coverage.beyond, 0U);
    EXPECT_EQ(found.verification.nanPixels, 0U);
    EXPECT_LE(found.verification.positionPx.max, 1e-4 + 1.01 * found.verification.positionPx.floor);
    EXPECT_LE(found.verification.normalDegrees.max, 1e-5);
    return found;
  }
};

Scene litPlane(Node node, const Camera& camera) {
  Scene scene;
  scene.add(std::move(node));
  scene.add(Node{.translation = Vec3(2, 5, 3), .light = Light{.intensity = 0.8}});
  scene.add(camera);
  return scene;
}

/// An annulus.
Surface ring(double inner, double outer) {
  return surface(
      [=](auto u, auto v) {
        const Expr radius = inner + (outer - inner) * v;
        return point(radius * cos(kTau * u), 0.0, -(radius * sin(kTau * u)));
      },
      {});
}

// The horizon runs through the centres of a row of pixels.
TEST_F(ExactPlane, OutToTheHorizon) {
  const Camera level{.eye = Vec3(0.3, 1, 0), .lookAt = Vec3(0.3, 1, -1), .fovY = radians(60)};
  for (const double size : {20.0, 1e3, 1e6}) {
    SCOPED_TRACE(size);
    const Verified found =
        expectAsRightAsFloats(litPlane({.surface = rectangle(size, size)}, level), {129, 97}, 3000);
    EXPECT_GE(found.verification.color.psnrLinear, 110);
  }
}

TEST_F(ExactPlane, FromBothSidesAndMirrored) {
  for (const double height : {1.5, -1.5})
    for (const Vec3& scale : {Vec3(1, 0, 1), Vec3(0.3, 1, -2)})
      for (const Projection projection : {Projection::Perspective, Projection::Orthographic}) {
        SCOPED_TRACE(height);
        const Camera camera{.eye = Vec3(1, height, 3), .projection = projection, .height = 3};
        for (const Surface& surface : {rectangle(2, 1), disk(1), ring(0.4, 1)})
          expectTheTruth(
              takeSnapshot(
                  litPlane({.rotation = Rotation{{1, 2, 3}, 0.2}, .scale = scale, .surface = surface},
                           camera),
                  0, {160, 120}),
              200);
      }
}

// Rays that barely come down: a thousandth of a metre per metre.
TEST_F(ExactPlane, SeenAtAGrazingAngle) {
  for (const Projection projection : {Projection::Perspective, Projection::Orthographic}) {
    const Camera camera{
        .eye = Vec3(3, 0.003, 4), .fovY = radians(0.5), .projection = projection, .height = 0.01};
    expectAsRightAsFloats(litPlane({.surface = disk(1)}, camera), {160, 120}, 100);
  }
}

TEST_F(ExactPlane, EyeOnItAndBesideIt) {
  Scene scene;
  scene.set(plainSettings());
  scene.add(Node{.surface = rectangle(4, 4), .material = scene.add(glowing(Vec3(0, 1, 0)))});
  constexpr PixelSize kSize{65, 65};
  for (const double height : {1e-3, 1e-6, 0.0, -1e-6, -1e-3}) {
    SCOPED_TRACE(height);
    // Down or up at what is in front of it, so that the whole picture shows it; edge-on nobody sees it.
    const Camera camera{.eye = Vec3(0, height, 0),
                        .lookAt = Vec3(0, height > 0 ? -1 : 1, -1),
                        .fovY = radians(60),
                        .near = 1e-9};
    const Image color = draw(scene, camera, kSize).image;
    for (int y = 0; y < kSize.height; ++y)
      for (int x = 0; x < kSize.width; ++x)
        ASSERT_EQ(colorAt(color, x, y).y, height == 0 ? 0 : 1) << x << ", " << y;
  }
}

TEST_F(ExactPlane, OneSidedFromBehindIsNotSeen) {
  Scene scene;
  scene.set(plainSettings());
  Material material = glowing(Vec3(0, 1, 0));
  material.twoSided = TwoSided::No;
  scene.add(Node{.surface = rectangle(2, 2), .material = scene.add(std::move(material))});
  for (const double height : {2.0, -2.0}) {
    const Camera camera{.eye = Vec3(0, height, 0), .up = Vec3(0, 0, 1)};
    for (const bool skips : {true, false}) {
      const Image color = draw(scene, camera, {33, 33}, {.skips = skips ? Skips{} : Skips::none()}).image;
      EXPECT_EQ(colorAt(color, 16, 16).y, height > 0 ? 1 : 0);
    }
  }
}

// Each of the four samples finds its own place.
TEST_F(ExactPlane, EdgesHaveTheirSamples) {
  Scene scene;
  scene.set(plainSettings());
  scene.add(Node{.rotation = Rotation{{0, 1, 0}, 0.3},
                 .surface = rectangle(1, 1),
                 .material = scene.add(glowing(Vec3(0, 1, 0)))});
  constexpr PixelSize kSize{48, 40};
  const Camera camera{.eye = Vec3(0.5, 2, 1.5)};
  const CameraModel model(camera, kSize);
  const auto inside = [&](const Vec2& pixel) {
    const Ray ray = model.through(pixel);
    const Vec3 p = ray.at(*hitPlane(ray, Vec3(0), Vec3(0, 1, 0)));
    const double c = std::cos(0.3), s = std::sin(0.3);
    return std::max(std::abs(c * p.x - s * p.z), std::abs(s * p.x + c * p.z)) <= 0.5;
  };
  const Image color = draw(scene, camera, kSize, {.samples = 4}).image;
  int partly = 0;
  for (int y = 0; y < kSize.height; ++y)
    for (int x = 0; x < kSize.width; ++x) {
      int samples = 0;
      for (const Vec2& at : sampleLocations(4)) samples += inside(Vec2(x, y) + at);
      // A mean of four pictures: each moves it by less than 1e-7 (draw/accumulation.h).
      EXPECT_NEAR(colorAt(color, x, y).y, samples / 4.0, 4e-7) << x << ", " << y;
      partly += samples % 4 != 0;
    }
  EXPECT_GT(partly, 40);
}

// A device without doubles searches for them as for other quadrics.
TEST_F(ExactPlane, IsFoundWithoutDoubles) {
  const Scene scene = litPlane({.surface = rectangle(2, 2)}, {.eye = Vec3(1, 2, 2)});
  const Snapshot snapshot = takeSnapshot(scene, 0, {96, 96});
  const Image with = renderer().render(snapshot, {.shading = Shading::Exact}).image;
  const Image without = renderer().render(snapshot, {.shading = Shading::Exact, .doubles = false}).image;
  for (int y = 0; y < 96; ++y)
    for (int x = 0; x < 96; ++x)
      EXPECT_TRUE(near(colorAt(with, x, y), colorAt(without, x, y), 1e-5)) << x << ", " << y;
}

}  // namespace
}  // namespace luxo::test
