// SPDX-License-Identifier: Apache-2.0
// Proven coverage of pixels against areas in closed form: half planes, circles, rings.
#include "reference/coverage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "surface/catalogue.h"
#include "surface/library.h"

namespace luxo::reference {
namespace {

constexpr PixelSize kCoveredSize{8, 8};
constexpr double kResolution = 1.0 / 1024;

/// One pixel is one metre; the picture's middle is the origin, seen along -Z.
Camera flatCamera() {
  return {.eye = Vec3(0, 0, 50),
          .lookAt = Vec3(0),
          .near = 1,
          .projection = Projection::Orthographic,
          .height = 8};
}

Snapshot seen(Node node, const Camera& camera, const Material& material = {}) {
  Scene scene;
  node.material = scene.add(material);
  scene.add(std::move(node));
  return takeSnapshot(scene, 0, kCoveredSize, camera);
}

void expectHolds(const CoverageBounds& bounds, double truth, double resolution = kResolution) {
  EXPECT_LE(bounds.lower, truth + 1e-12);  // what double makes of the closed forms
  EXPECT_GE(bounds.upper, truth - 1e-12);
  EXPECT_LE(bounds.upper - bounds.lower, resolution);
}

/// Area of the unit square's part below the line y = height + slope x.
double areaBelow(double height, double slope) {
  const auto integral = [](double y) { return y < 0 ? 0 : y < 1 ? 0.5 * y * y : y - 0.5; };
  if (slope == 0) return std::clamp(height, 0.0, 1.0);
  return (integral(height + slope) - integral(height)) / slope;
}

/// Area of the square from (x, y) to (x + 1, y + 1), x, y >= 0, within a circle around the origin.
double areaInCircle(double x, double y, double radius) {
  const auto until = [&](double height) {
    return std::clamp(std::sqrt(std::max(0.0, radius * radius - height * height)), x, x + 1);
  };
  const auto integral = [&](double t) {  // of sqrt(radius^2 - t^2)
    const double s = std::min(t / radius, 1.0);
    return 0.5 * radius * radius * (s * std::sqrt(1 - s * s) + std::asin(s));
  };
  const double full = until(y + 1), end = until(y);
  return (full - x) + integral(end) - integral(full) - y * (end - full);
}

// The edge of a large square through pixel (4, 4), which reaches from the origin to (1, -1), at any angle.
TEST(ReferenceCoverage, HalfPlanes) {
  for (int degrees = 0; degrees < 90; degrees += 15) {
    const double angle = radians(degrees), slope = std::tan(angle);
    const Vec3 onEdge(0.3, -0.4, 0);
    Scene scene;
    const NodeId turned =
        scene.add(Node{.translation = onEdge - 20.0 * Vec3(-std::sin(angle), std::cos(angle), 0),
                       .rotation = Rotation{{0, 0, 1}, angle}});
    scene.add(
        Node{.parent = turned, .rotation = Rotation{{1, 0, 0}, radians(90)}, .surface = rectangle(40, 40)});
    const Snapshot snapshot = takeSnapshot(scene, 0, kCoveredSize, flatCamera());
    expectHolds(pixelCoverage(Caster(snapshot), 4, 4), areaBelow(1 - 0.4 - 0.3 * slope, slope));
  }
}

// All pixels of a quarter of the picture, empty and covered ones as well; and the same ball in perspective,
// where its outline is a circle again.
TEST(ReferenceCoverage, Circles) {
  constexpr double kRadius = 2.3, kDistance = 7;
  const Camera near{.eye = Vec3(0, 0, kDistance), .lookAt = Vec3(0), .fovY = radians(60), .near = 0.1};
  const double apparent = kRadius / std::sqrt(kDistance * kDistance - kRadius * kRadius);
  for (const bool perspective : {false, true})
    for (const TwoSided sides : {TwoSided::Yes, TwoSided::No}) {
      const Snapshot snapshot =
          seen({.surface = sphere(kRadius)}, perspective ? near : flatCamera(), {.twoSided = sides});
      constexpr double kCoarse = 1.0 / 32;
      const double radius = perspective ? apparent * snapshot.view.pixelsPerUnit : kRadius;
      const Caster caster(snapshot);
      for (int y = 0; y < 4; ++y)
        for (int x = 4; x < 8; ++x)
          expectHolds(pixelCoverage(caster, x, y, kCoarse), areaInCircle(x - 4, 3 - y, radius), kCoarse);
      expectHolds(pixelCoverage(caster, 6, 3), areaInCircle(2, 0, radius));
    }
}

// A ring far thinner than a pixel: what the pixels of a quarter of the picture hold of it is a quarter of its
// area.
TEST(ReferenceCoverage, ThinRings) {
  constexpr double kRing = 2, kTube = 0.04, kCoarse = 1.0 / 256;
  const Snapshot snapshot =
      seen({.rotation = Rotation{{1, 0, 0}, radians(90)}, .surface = torus(kRing, kTube)}, flatCamera());
  const Caster caster(snapshot);
  CoverageBounds sum{0, 0};
  for (int y = 0; y < 4; ++y)
    for (int x = 4; x < 8; ++x) {
      const CoverageBounds part = pixelCoverage(caster, x, y, kCoarse);
      EXPECT_LE(part.upper - part.lower, kCoarse) << x << ' ' << y;
      sum.lower += part.lower;
      sum.upper += part.upper;
    }
  const double area = kPi * kRing * kTube;
  EXPECT_LE(sum.lower, area);
  EXPECT_GE(sum.upper, area);
  EXPECT_GT(sum.lower, 0.9 * area);  // the ring runs through 5 pixels: 5 / 256 are 8 % of it
}

// Of two half planes that leave a gap of 0.2 in a pixel each has its own part, and both have the sum.
TEST(ReferenceCoverage, OneNodeOrAll) {
  Scene scene;
  const auto add = [&](double middle) {
    scene.add(Node{.translation = Vec3(middle, 0, -std::abs(middle)),
                   .rotation = Rotation{{1, 0, 0}, radians(90)},
                   .surface = rectangle(10, 40)});
  };
  add(-5 + 0.3);
  add(5 + 0.5);
  const Snapshot snapshot = takeSnapshot(scene, 0, kCoveredSize, flatCamera());
  const Caster caster(snapshot);
  expectHolds(pixelCoverage(caster, 4, 2, kResolution, 0), 0.3);
  expectHolds(pixelCoverage(caster, 4, 2, kResolution, 1), 0.5);
  expectHolds(pixelCoverage(caster, 4, 2), 0.8);
}

// The near plane cuts a ball in two: its far inside is seen, or is not where backs do not count.
TEST(ReferenceCoverage, NearPlaneAndBacksCountAsInThePicture) {
  Camera cut = flatCamera();
  cut.near = 50;  // through the middle
  for (const TwoSided sides : {TwoSided::Yes, TwoSided::No}) {
    const Snapshot snapshot = seen({.surface = sphere(2.3)}, cut, {.twoSided = sides});
    expectHolds(pixelCoverage(Caster(snapshot), 4, 3), sides == TwoSided::Yes ? 1 : 0);
  }
}

// Where no area is known: within what a grid of rays can say. Pixels on outlines, of many patches.
TEST(ReferenceCoverage, TeapotAgreesWithManyRays) {
  constexpr int kGrid = 16;
  Scene scene;
  scene.add(Node{.surface = makeSurface("teapot")});
  const Snapshot snapshot =
      takeSnapshot(scene, 0, {96, 72}, Camera{.eye = Vec3(1, 4, 9), .lookAt = Vec3(0, 1.5, 0)});
  const Caster caster(snapshot);
  const auto hits = [&](double x, double y) { return !caster.look(caster.rayThrough(x, y)).hits.empty(); };
  int edges = 0;
  for (int y = 20; y < 60; y += 16)
    for (int x = 0; x < 95; ++x) {
      if (hits(x, y + 0.5) == hits(x + 1, y + 0.5)) continue;
      ++edges;
      int count = 0;
      for (int i = 0; i < kGrid * kGrid; ++i)
        count += hits(x + (i % kGrid + 0.5) / kGrid, y + (i / kGrid + 0.5) / kGrid);
      const CoverageBounds bounds = pixelCoverage(caster, x, y, 1.0 / 4);
      EXPECT_LE(bounds.upper - bounds.lower, 1.0 / 4);
      // Of the squares of the grid an outline runs through 2 kGrid at most, and splits each somewhere.
      const double seenPart = static_cast<double>(count) / (kGrid * kGrid);
      EXPECT_GE(seenPart, bounds.lower - 1.0 / kGrid) << x << ' ' << y;
      EXPECT_LE(seenPart, bounds.upper + 1.0 / kGrid) << x << ' ' << y;
    }
  EXPECT_GE(edges, 4);
}

}  // namespace
}  // namespace luxo::reference
