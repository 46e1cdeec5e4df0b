// SPDX-License-Identifier: Apache-2.0
// Pictures of many passes: what the mean of them is, and that nothing else changes.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "support/picture.h"

namespace luxo::test {
namespace {

using Accumulation = PictureTest;

/// How far the share of so many samples may be off the area beyond an edge (draw/accumulation.h).
double patternError(int samples) { return 2 / std::pow(samples, 0.75); }

Camera straightDown(double height) {
  return {.eye = Vec3(0, 0, 5), .projection = Projection::Orthographic, .height = height};
}

/// Area of the pixel where `inside` holds, by 64 x 64 points: an edge passes 64 rows of cells, so it is
/// within 64 * 2 half cells of 4096.
constexpr int kSampleGrid = 64;
constexpr double kGridError = 64.0 / (kSampleGrid * kSampleGrid);
double areaOf(const auto& inside, int x, int y) {
  int hits = 0;
  for (int j = 0; j < kSampleGrid; ++j)
    for (int i = 0; i < kSampleGrid; ++i)
      hits += inside(Vec2(x + (i + 0.5) / kSampleGrid, y + (j + 0.5) / kSampleGrid));
  return static_cast<double>(hits) / (kSampleGrid * kSampleGrid);
}

TEST_F(Accumulation, EdgesConvergeToTheirArea) {
  constexpr PixelSize kSize{48, 40};
  const double angle = radians(17), radius = 0.7;
  // 20 pixels per metre: a half plane on the right, a disk of 14 pixels radius on the left.
  Scene scene;
  scene.set(plainSettings());
  const MaterialId white = scene.add(glowing(Vec3(1)));
  Node half = plate(Vec3(5, 0, 0), {9, 60}, white);  // its left edge is 0.5 from the origin
  half.parent = scene.add(Node{.rotation = Rotation{{0, 0, 1}, angle}});
  scene.add(half);
  scene.add(Node{.translation = Vec3(-0.4, 0.1, 0), .surface = sphere(radius), .material = white});
  const Camera camera = straightDown(2);
  const CameraModel model(camera, kSize);
  const auto inside = [&](const Vec2& pixel) {
    const Vec3 p = model.through(pixel).at(5);
    return p.x * std::cos(angle) + p.y * std::sin(angle) > 0.5 || std::hypot(p.x + 0.4, p.y - 0.1) < radius;
  };
  std::vector<double> areas;
  for (int y = 0; y < kSize.height; ++y)
    for (int x = 0; x < kSize.width; ++x) areas.push_back(areaOf(inside, x, y));
  for (const Shading shading : {Shading::Phong, Shading::Exact}) {
    SCOPED_TRACE(nameOf(shading));
    std::array<double, 3> rms{};
    for (std::size_t i = 0; i < rms.size(); ++i) {
      const int samples = std::array{6, 40, 256}[i];
      const double tolerance = 0.02;
      const Image image =
          draw(scene, camera, kSize, {.shading = shading, .tolerancePx = tolerance, .samples = samples})
              .image;
      // The edge is drawn as far off as the mesh and the raster may put it; it is at most sqrt 2 long in a
      // pixel.
      const double allowed = patternError(samples) + kGridError + std::sqrt(2) * (tolerance + kSnapPx);
      int edges = 0;
      for (int y = 0; y < kSize.height; ++y)
        for (int x = 0; x < kSize.width; ++x) {
          const double area = areas[static_cast<std::size_t>(y * kSize.width + x)];
          const double error = colorAt(image, x, y).x - area;
          ASSERT_LE(std::abs(error), allowed) << x << ", " << y << " with " << samples << " samples";
          if (area == 0 || area == 1) continue;
          ++edges;
          rms[i] += error * error;
        }
      EXPECT_GT(edges, 100);
      rms[i] = std::sqrt(rms[i] / edges);
    }
    // From 6 to 40 and on to 256 samples the pattern's error falls by 4 each; that of the mesh and the raster
    // stays.
    EXPECT_LT(rms[1], 0.5 * rms[0]);
    EXPECT_LT(rms[2], 0.75 * rms[1]);
  }
}

/// Things smaller than a pixel, edges, a highlight, light beyond 1, something seen through.
Scene busyScene() {
  Scene scene;
  scene.set(plainSettings(Vec3(0.02, 0.025, 0.03)));
  const MaterialId bright = scene.add(glowing(Vec3(7.5, 2, 0.1))), glass = scene.add(glowing(Vec3(0.3), 0.4));
  for (int i = 0; i < 40; ++i)
    scene.add(Node{.translation = Vec3(-1.5 + 0.075 * i, 0.9 * std::sin(7.0 * i), 0),
                   .surface = sphere(i % 3 == 0 ? 0.3 : 0.004),
                   .material = i % 2 == 0 ? bright : MaterialId{}});
  scene.add(plate(Vec3(0.2, 0.1, 1), {1.1, 0.9}, glass));
  addLight(scene, {.position = Vec4(1, 2, 3, 1), .radiance = Vec3(3)});
  return scene;
}

TEST_F(Accumulation, IsTheMeanOfItsPasses) {
  constexpr PixelSize kSize{64, 48};
  constexpr int kSamples = 9;
  const Scene scene = busyScene();
  Snapshot snapshot = takeSnapshot(scene, 0, kSize, Camera{.eye = Vec3(0, 0, 4)});
  const Image image = renderer().render(snapshot, {.samples = kSamples}).image;
  const View view = snapshot.view;
  std::vector<double> sum(image.samples().size());
  std::vector<float> first;
  for (const Vec2& offset : samplePattern(kSamples)) {
    snapshot.view = sampledAt(view, offset);
    const Image pass = renderer().render(snapshot).image;
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += pass.samples()[i];
  }
  double brightest = 0;
  for (std::size_t i = 0; i < sum.size(); ++i) {
    const double mean = sum[i] / kSamples;
    brightest = std::max(brightest, mean);
    ASSERT_NEAR(image.samples()[i], mean, 1e-7 * kSamples * mean) << i;
  }
  EXPECT_GT(brightest, 5) << "unclamped";
}

TEST_F(Accumulation, TellsTheLargestResidual) {
  constexpr int kSamples = 5;
  Snapshot snapshot = takeSnapshot(busyScene(), 0, {64, 48}, Camera{.eye = Vec3(0, 0, 4)});
  const DrawOptions exact{.shading = Shading::Exact};
  DrawOptions many = exact;
  many.samples = kSamples;
  const FrameError whole = renderer().render(snapshot, many).statistics.error;
  const View view = snapshot.view;
  double largest = 0;
  std::uint64_t mostUncertain = 0, allUncertain = 0;
  for (const Vec2& offset : samplePattern(kSamples)) {
    snapshot.view = sampledAt(view, offset);
    const FrameError pass = renderer().render(snapshot, exact).statistics.error;
    ASSERT_TRUE(pass.residualMaxPx.has_value());
    largest = std::max(largest, *pass.residualMaxPx);
    mostUncertain = std::max(mostUncertain, pass.uncertifiedPx);
    allUncertain += pass.uncertifiedPx;
  }
  ASSERT_TRUE(whole.residualMaxPx.has_value());
  EXPECT_GT(largest, 0);
  // Where it is not certain it was added to 16, whose neighbours are 1.9e-6 apart.
  EXPECT_NEAR(*whole.residualMaxPx, largest, 2e-6);
  // Pixels that are uncertain in any pass.
  EXPECT_GE(whole.uncertifiedPx, mostUncertain);
  EXPECT_LE(whole.uncertifiedPx, allUncertain);
}

TEST_F(Accumulation, WhatDoesNotVaryStays) {
  Scene scene;
  const Vec3 color(0.1f, 0.3f, 11.7f);
  scene.set(plainSettings());
  scene.add(plate(Vec3(0), {8, 8}, scene.add(glowing(color))));
  const Image image = draw(scene, straightDown(2), {8, 8}, {.samples = 256}).image;
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) EXPECT_TRUE(near(colorAt(image, x, y) / color, Vec3(1), 1e-7 * 256));
}

TEST_F(Accumulation, SkipsLeaveNoTrace) {
  Skips none{};
  none.frustum = none.small = none.backface = none.lights = none.unchanged = none.passes = false;
  const Scene scene = busyScene();
  const Camera camera{.eye = Vec3(0.3, 0.4, 2)};  // things lie across the border
  const Picture skipped = draw(scene, camera, {64, 48}, {.samples = 16});
  const Picture all = draw(scene, camera, {64, 48}, {.samples = 16, .skips = none});
  EXPECT_TRUE(sameBytes(skipped.image, all.image));
  EXPECT_GT(skipped.statistics.count.culledSmall + skipped.statistics.count.culledFrustum, 5u);
}

TEST_F(Accumulation, AuxiliaryOutputsAreOfThePixelsCentre) {
  for (const Output output : {Output::Depth, Output::Position, Output::Normal, Output::Uv, Output::Id}) {
    const Picture one = draw(busyScene(), Camera{.eye = Vec3(0, 0, 4)}, {64, 48}, {.output = output});
    const Picture many =
        draw(busyScene(), Camera{.eye = Vec3(0, 0, 4)}, {64, 48}, {.output = output, .samples = 16});
    EXPECT_TRUE(sameBytes(one.image, many.image));
    EXPECT_EQ(many.statistics.count.submits, one.statistics.count.submits);
  }
}

TEST_F(Accumulation, CostsAPassPerSample) {
  const Camera camera{.eye = Vec3(0, 0, 4)};
  // Meshes are drawn once; shells may be made finer and drawn again.
  const Picture one = draw(busyScene(), camera, {64, 48}, {.shading = Shading::Phong});
  const Picture seven = draw(busyScene(), camera, {64, 48}, {.shading = Shading::Phong, .samples = 7});
  const FrameCounts &a = one.statistics.count, &b = seven.statistics.count;
  EXPECT_LE(b.submits, 14u) << "each is drawn, then added";
  EXPECT_GT(b.submits, 0U);
  EXPECT_EQ(b.passes, 7 * a.passes);
  EXPECT_EQ(b.nodes, a.nodes);
  EXPECT_EQ(b.drawn + b.culledFrustum + b.culledSmall + b.culledBackface, b.nodes);
  EXPECT_GT(b.drawCalls, 3 * a.drawCalls);
  EXPECT_EQ(seven.statistics.error.boundPx, one.statistics.error.boundPx);
}

TEST_F(Accumulation, CanBeGivenUp) {
  const Snapshot snapshot = takeSnapshot(busyScene(), 0, {64, 48}, Camera{.eye = Vec3(0, 0, 4)});
  const DrawOptions options{.samples = 8, .skips = {.unchanged = false}};
  const Image whole = renderer().render(snapshot, options).image;
  std::vector<double> told;
  EXPECT_FALSE(renderer().render(snapshot, options, [&](double done) {
    told.push_back(done);
    return told.size() < 4;
  }));
  EXPECT_EQ(told, (std::vector<double>{0, 0.125, 0.25, 0.375}));
  EXPECT_TRUE(sameBytes(renderer().render(snapshot, options).image, whole));
}

}  // namespace
}  // namespace luxo::test
