// SPDX-License-Identifier: Apache-2.0
// Surfaces that no shell is made for: rays find their points, the renderer lights them.
#include "draw/ray_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "cull/cull.h"
#include "draw/draw_list.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "support/verified_picture.h"

namespace luxo::test {
namespace {

using RayPointsTest = VerifiedPictureTest;

/// Kinks along both diagonals, of which no second derivative is bounded, with a pattern; beside a ball.
Snapshot pyramid(PixelSize size) {
  return takeSnapshot(buildScene(parseScene(R"json({ "luxo": 1,
    "materials": { "checks": { "diffuse": ["0.5 + 0.4*u", "0.5 - 0.4*v", 0.2], "two_sided": true } },
    "surfaces": {
      "roof": { "type": "formula", "u": [-1, 1], "v": [-1, 1],
                "position": ["u", "0.7 - 0.7*max(abs(u), abs(v))", "v"] },
      "ball": { "type": "sphere", "radius": 0.3 } },
    "nodes": [
      { "translate": [3, 6, 4], "light": {} },
      { "surface": "roof", "material": "checks" },
      { "surface": "ball", "translate": [0.9, 0.7, 0.6] } ],
    "camera": { "eye": [1.2, 2.1, 2.6], "look_at": [0, 0.2, 0], "fov_y": "45deg" } })json",
                                            "pyramid")),
                      0, size);
}

TEST_F(RayPointsTest, AreTheTruthInEveryOutput) {
  const Snapshot snapshot = pyramid({240, 180});
  const Verified found = expectTheTruth(snapshot, 8000);
  const FrameError& error = found.statistics.error;
  EXPECT_GT(error.resolvedByRaysPx, 8000U) << "or a shell was made";
  EXPECT_EQ(error.uncertifiedPx, 0U);
  EXPECT_EQ(error.auditFailedPx, 0U);
  EXPECT_LE(found.verification.normalDegrees.max, 1e-3);
  EXPECT_EQ(found.verification.wrong.total(), 0U);
}

TEST_F(RayPointsTest, CertificatesSayWhoFoundThePoint) {
  const Snapshot snapshot = pyramid({240, 180});
  const Image by = renderer().render(snapshot, {.output = Output::Certificate}).image,
              id = renderer().render(snapshot, {.output = Output::Id}).image;
  std::uint64_t ofRoof = 0;
  for (int y = 0; y < by.height(); ++y)
    for (int x = 0; x < by.width(); ++x) {
      const float certificate = by.pixel(x, y)[0], number = id.pixel(x, y)[0];
      ASSERT_EQ(certificate == 0, number == 0) << x << ", " << y;
      if (number == 2) {
        ASSERT_EQ(certificate, 2) << x << ", " << y;
        ++ofRoof;
      }
    }
  EXPECT_GT(ofRoof, 5000U);
}

/// Four sheets in one place: some rays do not prove which is the nearest.
TEST_F(RayPointsTest, WhatARayDoesNotProveIsNotCertified) {
  const Scene scene =
      buildScene(readSceneFile(std::filesystem::path(LUXO_CASES) / "covered_four_times_3603_169.luxo.json"));
  const Picture picture = draw(scene, scene.settings().size, {.output = Output::Certificate});
  std::uint64_t unproven = 0;
  for (int y = 0; y < picture.image.height(); ++y)
    for (int x = 0; x < picture.image.width(); ++x) unproven += picture.image.pixel(x, y)[0] == 3;
  EXPECT_GT(unproven, 0U);
  EXPECT_EQ(unproven, picture.statistics.error.uncertifiedPx);
}

// What a window shows until rays are done is a coarse mesh of what they find, and else nothing is drawn
// twice.
TEST(StandIns, AreMeshesOfWhatIsLeftToRays) {
  const Snapshot snapshot = pyramid({240, 180});
  const auto list = [&](const DrawOptions& options) {
    Geometry geometry;
    return listDraws(snapshot, cull(snapshot), options, geometry);
  };
  const auto meshes = [](const DrawList& draws) {
    return std::ranges::count_if(draws.opaque, [](const DrawBatch& b) { return b.mesh != nullptr; });
  };
  const DrawList found = list(DrawOptions{}), stoodIn = list(DrawOptions{.standIns = true});
  EXPECT_EQ(meshes(found), 0);
  EXPECT_EQ(meshes(stoodIn), 2) << "both sides of the roof, not the ball";
  EXPECT_EQ(stoodIn.byRays.size(), found.byRays.size());
  EXPECT_GT(stoodIn.boundPx, 0.5) << "it says how far off it may be";
  EXPECT_EQ(meshes(list(DrawOptions{.shading = Shading::Phong, .standIns = true})), 3);
}

// As many pixels as a picture has, at least 64 of them, each once, the same every time, outlines among them.
TEST(AuditedPixels, AreSpreadAndTheSameEveryTime) {
  const std::vector<PixelPlace> outlines{{3, 2}, {7, 5}, {3, 2}};
  EXPECT_EQ(auditedPixels({1024, 1024}, {}, {}).size(), 256U);
  EXPECT_EQ(auditedPixels({100, 80}, {}, {}).size(), 64U);
  EXPECT_EQ(auditedPixels({8, 8}, {}, {}).size(), 64U);
  EXPECT_EQ(auditedPixels({5, 4}, {}, outlines).size(), 20U) << "there are no more";
  EXPECT_EQ(auditedPixels({40, 30}, {.extent = AuditExtent::All}, {}).size(), 1200U);
  EXPECT_TRUE(auditedPixels({40, 30}, {.extent = AuditExtent::None}, outlines).empty());
  const auto some = auditedPixels({1000, 800}, {.atLeast = 300}, outlines);
  EXPECT_EQ(some, auditedPixels({1000, 800}, {.atLeast = 300}, outlines));
  EXPECT_EQ(some.size(), 302U);
  EXPECT_EQ(std::ranges::count(some, outlines[0]), 1);
  int quarters[4] = {};
  for (const PixelPlace& p : some) ++quarters[2 * (p.x >= 500) + (p.y >= 400)];
  for (const int quarter : quarters) EXPECT_NEAR(quarter, 75, 8);
}

}  // namespace
}  // namespace luxo::test
