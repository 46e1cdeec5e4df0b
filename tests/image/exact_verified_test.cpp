// SPDX-License-Identifier: Apache-2.0
// Exact pictures of the standard scenes, every pixel held against the ground truth of the reference engine.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <ostream>
#include <random>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "reference/reference.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "scenes/embedded_scenes.h"
#include "support/other_arguments.h"
#include "support/verified_picture.h"
#include "surface/catalogue.h"

namespace luxo::test {
namespace {

Scene embedded(std::string_view name) {
  for (const EmbeddedScene& scene : embeddedScenes())
    if (scene.name == name) return buildScene(parseScene(std::string(scene.text), std::string(name)));
  throw std::runtime_error("no such scene");
}

class ExactVerified : public VerifiedPictureTest, public testing::WithParamInterface<const char*> {};

INSTANTIATE_TEST_SUITE_P(Scenes, ExactVerified, testing::Values("sphere", "torus", "flag", "klein", "teapot"),
                         [](const auto& name) { return std::string(name.param); });

// A tube of two pixels: what float rounds away of a place on it turns its normal by 1e-4.
TEST_F(VerifiedPictureTest, SharpBendsKeepTheirColour) {
  const Verification found = verified(takeSnapshot(embedded("thin-torus"), 0, {512, 512})).verification;
  EXPECT_GT(found.coverage.both, 3000U);
  EXPECT_GE(found.color.psnrLinear, 110);
}

TEST_P(ExactVerified, EveryPixelIsWithinAThousandth) {
  const Verified found = expectTheTruth(takeSnapshot(embedded(GetParam()), 0, {256, 256}), 5000);
  EXPECT_LE(found.statistics.error.residualMaxPx.value(), 1e-3);
}

// Formulas of their arguments, in float and, magnified, in double. Along the valleys of the twisted torus
// rays run in its shell for many cells before they meet it.
TEST_F(VerifiedPictureTest, NamedSurfacesWithOtherArguments) {
  for (const char* name : {"flag", "mobius", "klein_figure8", "dupin_cyclide", "twisted_torus"})
    for (const bool magnified : {false, true}) {
      SCOPED_TRACE(std::string(name) + (magnified ? ", magnified" : ""));
      const Surface surface = makeSurface(name, otherArguments(*findCatalogueEntry(name)));
      const Box box = surface.framing({});
      const Vec3 middle = (box.min + box.max) / 2.0, target = magnified ? surface.position(0.3, 0.4) : middle;
      Scene scene;
      scene.add(Node{.surface = surface});
      scene.add(Node{.translation = Vec3(2, 5, 3), .light = Light{.intensity = 0.8}});
      const double size = glm::length(box.extent());
      scene.add(
          Camera{.eye = middle + size * Vec3(0.5, 0.6, 1), .lookAt = target, .fovY = magnified ? 0.03 : 0.7});
      expectTheTruth(takeSnapshot(scene, 0, {128, 128}), 100);
    }
}

// Of four samples each finds its own point: where a pass of single samples at the same places shows something
// else, the truth is with the four. From low beside the teapot, whose outlines are covered by slivers of its
// shell.
TEST_F(VerifiedPictureTest, EachOfFourSamplesIsRight) {
  Scene scene = embedded("teapot");
  constexpr PixelSize kSize{400, 300}, kBySamples{1600, 1200};
  constexpr std::array<int, 4> kColumns{1, 3, 0, 2};  // of the samples, a row of pixels of kBySamples each
  int differ = 0;
  for (const double turn : {0.0, 2.0}) {
    const Camera camera{.eye = Vec3(-6.221157, 2.075514, 1.666945),
                        .lookAt = Vec3(1.437427, 2.313905, 1.483217),
                        .up = Vec3(0, 1, 0.01),
                        .fovY = 0.8};
    const Snapshot snapshot = takeSnapshot(scene, turn, kSize, camera);
    const Image four = renderer().render(snapshot, {.shading = Shading::Exact, .samples = 4}).image;
    std::array<Image, 4> passes;
    for (std::size_t i = 0; i < 4; ++i) {
      Snapshot pass = snapshot;
      pass.view = sampledAt(snapshot.view, (Vec2(kColumns[i], i) + 0.5) / 4.0 - 0.5);
      passes[i] = renderer().render(pass, {.shading = Shading::Exact}).image;
    }
    const auto meanOf = [](const auto& colorOf) {
      Vec3 sum(0);
      for (int i = 0; i < 4; ++i) sum += colorOf(i) / 4.0;
      return sum;
    };
    const Snapshot bySamples = takeSnapshot(scene, turn, kBySamples, camera);
    for (int y = 0; y < kSize.height; ++y)
      for (int x = 0; x < kSize.width; ++x) {
        const Vec3 shown = colorAt(four, x, y);
        if (near(shown, meanOf([&](int i) { return colorAt(passes[static_cast<std::size_t>(i)], x, y); }),
                 2e-3))
          continue;
        ++differ;
        const auto column = [&](int i) { return 4 * x + kColumns[static_cast<std::size_t>(i)]; };
        ReferenceOptions chosen;
        for (int i = 0; i < 4; ++i)
          chosen.pixels.push_back(static_cast<std::uint32_t>((4 * y + i) * kBySamples.width + column(i)));
        const ReferencePicture truth = castPicture(bySamples, chosen);
        EXPECT_TRUE(
            near(shown, meanOf([&](int i) { return colorAt(truth.color, column(i), 4 * y + i); }), 2e-3))
            << x << ", " << y << " at " << turn;
      }
  }
  EXPECT_LE(differ, 4);
}

// Long steps lead a search along the valley, so that its pixels need no finer shell, and hardly a ray.
TEST_F(VerifiedPictureTest, ValleysAlongTheViewAreFoundAtOnce) {
  Scene scene;
  scene.add(Node{.surface = makeSurface("twisted_torus")});
  scene.add(Node{.translation = Vec3(3, 6, 4), .light = Light{}});
  scene.add(Camera{.eye = Vec3(2.2, 2.6, 3.4)});
  for (const int size : {144, 200}) {
    const FrameStatistics said = expectTheTruth(takeSnapshot(scene, 0, {size, size}), 5000).statistics;
    EXPECT_LE(said.count.tessellated, 1U);
    EXPECT_LE(said.error.resolvedByRaysPx, 24U);  // 22 at 200x200
  }
}

// Where asymptotic directions lie along the view, and at borders of horns, past which their other side is
// seen by rays that do not leave the shell in between.
TEST_F(VerifiedPictureTest, GrazedSaddlesAndTheInsideOfHorns) {
  constexpr const char* kNodes = R"({ "luxo": 1, "materials": { "m": { "diffuse": [0.2, 0.4, 0.6] } },
    "surfaces": { "enneper": { "type": "enneper" }, "scherk": { "type": "scherk" },
                  "tractricoid": { "type": "tractricoid" }, "dini": { "type": "dini" } },
    "nodes": [
      { "light": {}, "translate": [30, 60, 90] },
      { "surface": "enneper", "material": "m", "translate": [1.15, 1.15, 0], "scale": [0.591, 0.591, 0.591],
        "rotate": [{ "axis": [1, 0, 0], "angle": "40deg" }, { "axis": [0, 1, 0], "angle": "20deg" }] },
      { "surface": "scherk", "material": "m", "translate": [-1.15, 1.15, 0], "scale": [0.57, 0.57, 0.57],
        "rotate": [{ "axis": [1, 0, 0], "angle": "25deg" }, { "axis": [0, 1, 0], "angle": "25deg" }] },
      { "surface": "tractricoid", "material": "m", "translate": [-1.15, -1.15, 0], "scale": [0.692, 0.692, 0.692],
        "rotate": [{ "axis": [1, 0, 0], "angle": "12deg" }] },
      { "surface": "dini", "material": "m", "translate": [1.15, -1.15, 0], "scale": [0.533, 0.533, 0.533],
        "rotate": [{ "axis": [1, 0, 0], "angle": "8deg" }] } ],
    "camera": )";
  for (const char* camera :
       {R"({ "type": "orthographic", "height": 4.6, "eye": [0, 0, 10], "look_at": [0, 0, 0] } })",
        R"({ "type": "perspective", "fov_y": "0.5271deg", "eye": [0, 0, 500], "look_at": [0, 0, 0] } })",
        R"({ "type": "perspective", "fov_y": "13deg", "eye": [3, 5, 20], "look_at": [0, 0, 0] } })"}) {
    SCOPED_TRACE(camera);
    const Scene scene = buildScene(parseScene(std::string(kNodes) + camera, "horns"));
    expectTheTruth(takeSnapshot(scene, 0, {448, 448}), 30000);
  }
}

// A second root may have room in triangles that no ray grazes: there the first one is walked to, and rays
// are asked of 67 pixels; if such triangles counted as grazing, of 396.
TEST_F(VerifiedPictureTest, TransversalRootsAreWalkedTo) {
  const Scene scene = buildScene(parseScene(R"({ "luxo": 1,
    "surfaces": { "boy": { "type": "boy" } },
    "nodes": [ { "rotate": { "axis": [1, 0, 0], "angle": "30deg" }, "scale": [0.395, 0.395, 0.395], "surface": "boy" } ],
    "camera": { "eye": [0, 1, 6], "look_at": [0, 0.8, 0], "fov_y": "20deg" } })",
                                            "boy"));
  const Picture picture =
      renderer().render(takeSnapshot(scene, 0, {1024, 1024}), {.audit = {AuditExtent::None}});
  EXPECT_EQ(picture.statistics.error.unconvergedPx, 0U);
  EXPECT_LE(picture.statistics.error.resolvedByRaysPx, 150U);
}

struct Walk {
  const char* scene;
  std::vector<std::uint32_t> cameras;
  double shellPx = DrawOptions{}.shellTolerancePx;
};

void PrintTo(const Walk& walk, std::ostream* out) { *out << walk.scene; }

class ExactFromAnywhere : public VerifiedPictureTest, public testing::WithParamInterface<Walk> {
 protected:
  /// The scene from camera number `n` of a random walk around and through it, every third of parallel rays.
  static Snapshot snapshotFrom(const Scene& scene, std::uint32_t n, const PixelSize& size) {
    std::mt19937 random(n);
    const auto between = [&](double low, double high) { return low + (high - low) * random() * 0x1p-32; };
    const auto around = [&] {
      const double x = between(-1, 1), y = between(-1, 1);
      return Vec3(x, y, between(-1, 1));
    };
    Box box;
    for (const SnapshotNode& node : takeSnapshot(scene, 0, size).nodes)
      if (!node.boundsWorld.empty() && glm::length(node.boundsWorld.extent()) < 1e6)
        for (const Vec3& corner : {node.boundsWorld.min, node.boundsWorld.max}) box.add(corner);
    const double extent = glm::length(box.extent());
    const Vec3 way = glm::normalize(around());
    const double distance = extent * std::exp(between(std::log(0.3), std::log(3)));
    const Vec3 target = 0.5 * (box.min + box.max) + 0.2 * extent * around();
    Camera camera{.eye = target + distance * way, .lookAt = target, .up = Vec3(0, 1, 0.01), .fovY = 0.8};
    if (n % 3 == 2) {
      camera.projection = Projection::Orthographic;
      camera.height = 0.7 * distance;
    }
    return takeSnapshot(scene, between(0, 5), size, camera);
  }
};

// Each of these cameras once saw a pixel of a root that was not the nearest, of none, or of none at once:
// over waves whose triangles are transversal, past rims, from so near that float rounds away more than a
// search may leave, through what was taken to hide it, and where a cell of a shell held more than one fold.
INSTANTIATE_TEST_SUITE_P(Scenes, ExactFromAnywhere,
                         testing::Values(Walk{"showcase", {4, 13, 19, 25}, 3},
                                         Walk{"teapot", {2, 14, 52, 58}, 3}, Walk{"catalogue", {2, 28}, 3},
                                         Walk{"catalogue", {2, 9}, 2}, Walk{"showcase", {4, 25}},
                                         Walk{"teapot", {2, 58}}, Walk{"catalogue", {28}}),
                         [](const auto& walk) {
                           return fmt::format("{}_{:.0f}tenths_px", walk.param.scene,
                                              10 * walk.param.shellPx);
                         });

TEST_P(ExactFromAnywhere, TheNearestPointIsShown) {
  const Scene scene = embedded(GetParam().scene);
  for (const std::uint32_t camera : GetParam().cameras) {
    SCOPED_TRACE(camera);
    const Verified found = verified(snapshotFrom(scene, camera, {400, 300}), GetParam().shellPx);
    EXPECT_EQ(found.statistics.error.unconvergedPx, 0U);
    EXPECT_EQ(found.verification.coverage.beyond, 0U);
    EXPECT_LE(found.verification.positionPx.max, 1e-3);
    EXPECT_GT(found.verification.coverage.both, 1000U);
  }
}

// The shell's formula runs over long arcs, of which float keeps too few digits so near to it. It is
// searched for in double.
TEST_F(VerifiedPictureTest, WhatAFormulaRoundsAwayIsFound) {
  const Scene scene = buildScene(parseScene(R"({ "luxo": 1,
    "surfaces": { "shell": { "type": "seashell" } },
    "nodes": [ { "light": {}, "translate": [3, 6, 4] }, { "surface": "shell" } ],
    "camera": { "eye": [0.3, -2.17, 1.01], "look_at": [0.3, 0.1, 0.07], "fov_y": "20deg" } })",
                                            "shell"));
  const Verified found = verified(takeSnapshot(scene, 0, {400, 300}));
  EXPECT_EQ(found.statistics.error.unconvergedPx, 0U);
  EXPECT_EQ(found.verification.coverage.beyond, 0U);
  EXPECT_LE(found.verification.positionPx.max, 1e-3);
  EXPECT_GT(found.verification.coverage.both, 100'000U);
}

// At its border the horn is thinner than its slab, and what faces the viewer there is transversal.
TEST_F(VerifiedPictureTest, TheInsideOfAHornBesideItsBorder) {
  const Scene scene =
      buildScene(parseScene(R"({ "luxo": 1, "materials": { "m": { "diffuse": [0.2, 0.4, 0.6] } },
    "surfaces": { "horn": { "type": "tractricoid" }, "nearer": { "type": "sphere", "radius": 0.2 } },
    "nodes": [
      { "light": {}, "translate": [30, 60, 90] },
      { "surface": "nearer", "material": "m", "translate": [3, 3, 2] },
      { "surface": "horn", "material": "m", "translate": [-2.3, -0.679, -0.144], "scale": [0.692, 0.692, 0.692],
        "rotate": [{ "axis": [1, 0, 0], "angle": "12deg" }] } ],
    "camera": { "type": "orthographic", "height": 11.9, "eye": [0, 0, 10], "look_at": [0, 0, 0] } })",
                            "horn"));
  expectTheTruth(takeSnapshot(scene, 0, {1024, 1024}), 5000);
}

}  // namespace
}  // namespace luxo::test
