// SPDX-License-Identifier: Apache-2.0
// The ground truth against POV-Ray, an independent ray tracer, in 16 bits. Skipped where there is no
// `povray`, unless LUXO_REQUIRE_POVRAY=1.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "luxo_grandpa/lamp.h"
#include "povray/pov_picture.h"
#include "povray/pov_scene.h"
#include "reference/caster.h"
#include "reference/reference.h"
#include "surface/library.h"

namespace luxo::povray {
namespace {

constexpr PixelSize kSize{320, 240};
constexpr double kFull = 65535;
constexpr double kNearSilhouette = 0.01;  // pixels
constexpr double kTolerance = 2;          // of 65535

/// Whether another surface, or none, is seen 0.01 pixels from the pixel's centre.
bool atSilhouette(const reference::Caster& caster, int x, int y) {
  const auto nodeAt = [&](double dx, double dy) {
    const auto sight = caster.look(caster.rayThrough(x + 0.5 + dx, y + 0.5 + dy));
    return sight.hits.empty() ? -1 : static_cast<int>(sight.hits.front().node);
  };
  const int middle = nodeAt(0, 0);
  for (int i = 0; i < 8; ++i)
    if (nodeAt(kNearSilhouette * std::cos(i * kPi / 4), kNearSilhouette * std::sin(i * kPi / 4)) != middle)
      return true;
  return false;
}

class PovRay : public testing::Test {
 protected:
  void SetUp() override {
    if (isInstalled()) return;
    const char* required = std::getenv("LUXO_REQUIRE_POVRAY");
    if (required != nullptr && std::string(required) == "1") FAIL() << "povray is not installed";
    GTEST_SKIP() << "povray is not installed";
  }

  static void expectSame(const Snapshot& snapshot) {
    const ReferencePicture truth = castPicture(snapshot);
    const std::vector<double> referee = render(sceneText(snapshot), kSize).samples;
    const reference::Caster caster(snapshot);
    int covered = 0, silhouette = 0;
    double largest = 0;
    for (int y = 0; y < kSize.height; ++y)
      for (int x = 0; x < kSize.width; ++x) {
        const std::size_t i = static_cast<std::size_t>(y * kSize.width + x);
        double off = 0;
        for (std::size_t c = 0; c < 3; ++c) {
          const double value = static_cast<double>(truth.color.samples()[3 * i + c]);
          ASSERT_LT(value, 1) << "too bright to compare at " << x << ',' << y;
          off = std::max(off, kFull * std::abs(value - referee[3 * i + c]));
        }
        covered += truth.number[i] != 0;
        if (off > kTolerance && atSilhouette(caster, x, y)) {
          ++silhouette;
          continue;
        }
        largest = std::max(largest, off);
        EXPECT_LE(off, kTolerance) << x << ',' << y << " node " << truth.number[i];
      }
    EXPECT_GT(covered, kSize.width * kSize.height / 20);
    // Within 0.01 pixels of an outline lie at most 2 % of the pixels that it runs through.
    EXPECT_LE(silhouette, (kSize.width + kSize.height) / 50);
    RecordProperty("covered", covered);
    RecordProperty("differing_at_silhouettes", silhouette);
    RecordProperty("largest_difference", fmt::format("{:.3f}", largest));
    fmt::print("{} pixels covered, {} at silhouettes differ, largest difference elsewhere {:.3f} of 65535\n",
               covered, silhouette, largest);
  }
};

TEST_F(PovRay, AgreesOnTheLamp) {
  for (const double time : {3.0, 21.0}) expectSame(comparable(takeSnapshot(luxoGrandpa(), time, kSize), 0.2));
}

// Spheres and a torus, all turned and stretched: POV-Ray knows a torus to 1e-4 of a length, so large ones.
TEST_F(PovRay, AgreesOnEllipsoidsAndATorus) {
  Scene scene;
  const MaterialId red =
      scene.add(Material{.diffuse = {0.6, 0.2, 0.1}, .specular = Vec3(0.4), .shininess = 20});
  scene.add(Node{.translation = Vec3(-160, 20, 0),
                 .rotation = Rotation{{1, 2, 3}, 0.7},
                 .scale = Vec3(130, 60, 90),
                 .surface = sphere(1),
                 .material = red});
  scene.add(Node{.translation = Vec3(120, -10, 0),
                 .rotation = Rotation{{2, 0, 1}, 0.9},
                 .surface = torus(130, 50),
                 .material = red});
  scene.add(Node{.translation = Vec3(300, 500, 400), .light = Light{}});
  scene.add(
      Node{.rotation = Rotation{{0, 1, 0}, radians(-50)}, .light = Light{.type = Light::Type::Directional}});
  scene.add(Camera{.eye = Vec3(0, 100, 600), .lookAt = Vec3(0), .fovY = radians(45)});
  expectSame(comparable(takeSnapshot(scene, 0, kSize), 0.4));
}

}  // namespace
}  // namespace luxo::povray
