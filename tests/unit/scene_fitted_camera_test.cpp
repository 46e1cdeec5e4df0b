// SPDX-License-Identifier: Apache-2.0
// The camera of scenes that have none: what is there fills 85 % of the picture, and nothing is out of it.
#include "scene/fitted_camera.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "scene_test_support.h"
#include "scenes/embedded_scenes.h"
#include "surface/catalogue.h"

namespace luxo {
namespace {

using test::expectNear;

/// Of the picture: 0 to 1 is all of it.
struct Coverage {
  Vec2 least{std::numeric_limits<double>::infinity()}, most = -least;

  [[nodiscard]] double larger() const { return std::max(most.x - least.x, most.y - least.y); }
};

/// By many more samples than the camera is fitted with, at odd places.
Coverage coverageOf(const Snapshot& snapshot) {
  const View& view = snapshot.view;
  Coverage coverage;
  for (const SnapshotNode& node : snapshot.nodes)
    for (std::uint32_t patch = 0; patch < node.surface.patchCount(); ++patch) {
      const int perSide = std::max(30, 301 / static_cast<int>(std::sqrt(node.surface.patchCount())));
      const Domain& domain = node.surface.patchDomain(patch);
      std::vector<double> us, vs;
      for (int k = 0; k < perSide; ++k) {
        us.push_back(domain.u.lo + domain.u.width() * k / (perSide - 1));
        vs.push_back(domain.v.lo + domain.v.width() * k / (perSide - 1));
      }
      for (const Vec3& p : node.surface.evaluateGrid(patch, us, vs, node.parameters).position) {
        if (!std::isfinite(glm::dot(p, p))) continue;
        const Vec3 eye = eyeFromWorldPoint(view, transformPoint(node.worldFromObject, p));
        EXPECT_GT(-eye.z, view.near);
        const Vec2 part = pixelFromEye(view, eye) / Vec2(view.size.width, view.size.height);
        coverage.least = glm::min(coverage.least, part);
        coverage.most = glm::max(coverage.most, part);
      }
    }
  return coverage;
}

/// 85 %, and as much room on one side as on the other, but for what lies between samples.
void expectFits(const Scene& scene, const std::string& what, PixelSize size = {1280, 720}) {
  SCOPED_TRACE(what);
  const Coverage coverage = coverageOf(takeSnapshot(scene, scene.settings().time, size));
  EXPECT_GT(coverage.larger(), 0.83);
  EXPECT_LT(coverage.larger(), 0.861);
  EXPECT_NEAR(coverage.least.x, 1 - coverage.most.x, 0.01);
  EXPECT_NEAR(coverage.least.y, 1 - coverage.most.y, 0.01);
}

Scene sceneWith(const Surface& surface) {
  Scene scene;
  scene.add(Node{.surface = surface});
  return scene;
}

Surface peaks() {
  return surface(
      [](auto x, auto y) {
        const auto hill = [](auto a, auto b) { return exp(-(a * a) - b * b); };
        const auto z = 3.0 * (1.0 - x) * (1.0 - x) * hill(x, y + 1.0) -
                       10.0 * (0.2 * x - x * x * x - y * y * y * y * y) * hill(x, y) -
                       1.0 / 3 * hill(x + 1.0, y);
        return point(x, 0.3 * z, -y);
      },
      {{-3, 3}, {-3, 3}});
}

TEST(FittedCamera, FillsThePictureInOneDirectionAndCutsNothingOff) {
  for (const PixelSize size : {PixelSize{1280, 720}, {720, 1280}, {100, 100}, {16, 1000}})
    expectFits(sceneWith(peaks()), "peaks", size);
  for (const CatalogueEntry& entry : catalogue())
    expectFits(sceneWith(makeSurface(entry)), std::string(entry.name));
}

TEST(FittedCamera, FitsTheBuiltInScenesWithoutTheirCameras) {
  for (const EmbeddedScene& embedded : embeddedScenes()) {
    SceneFile file = parseScene(std::string(embedded.text), std::string(embedded.name));
    file.camera.reset();
    file.cameras.clear();
    expectFits(buildScene(file), std::string(embedded.name));
  }
}

TEST(FittedCamera, StandsWhereItIsAskedTo) {
  const Snapshot ball = takeSnapshot(sceneWith(sphere(1)), 0, {100, 100}, Camera{});
  for (const Vec3 direction : {kFittedDirection, Vec3(-3, 1, 0), Vec3(0, 0, -1), Vec3(0, 1, 0)}) {
    const Camera camera = fitCamera(ball, {100, 100}, direction);
    expectNear(unit(camera.eye.at(0) - camera.lookAt.at(0)), unit(direction), 1e-12);
    EXPECT_DOUBLE_EQ(camera.fovY.at(0), radians(40));
  }
}

TEST(FittedCamera, WhatIsThinnerThanAnySamplingIsInThePicture) {
  // A needle as thin as a thousandth of the square, between all samples, and as high as the square is wide.
  const Surface needle = surface(
      [](auto u, auto v) {
        const auto x = 1000.0 * (u - 0.3141), y = 1000.0 * (v - 0.2718);
        return point(u, 2.0 * exp(-(x * x) - y * y), v);
      },
      {{-1, 1}, {-1, 1}});
  const PixelSize size{320, 180};
  const View view = takeSnapshot(sceneWith(needle), 0, size).view;
  const Vec2 tip = pixelFromEye(view, eyeFromWorldPoint(view, Vec3(0.3141, 2, 0.2718)));
  EXPECT_GT(tip.y, 0.06 * size.height);
  EXPECT_LT(tip.y, 0.09 * size.height) << "as high as it, and no higher";
}

// Around r = 0 interval bounds tell nothing but that it is below 3e9.
TEST(FittedCamera, WhatBoundsDoNotExcludeIsNotLookedFor) {
  expectFits(sceneWith(surface(
                 [](auto x, auto y) {
                   const auto r = 6.0 * sqrt(x * x + y * y);
                   return point(x, 3.0 * sin(r) / (r + 1e-9), -y);
                 },
                 {{-2, 2}, {-2, 2}})),
             "sin(r) / (r + 1e-9)");
}

TEST(FittedCamera, BordersAndPolesAreSeen) {
  const Surface dome =
      surface([](auto u, auto v) { return point(u, sqrt(1.0 - u * u - v * v), -v); }, {{-2, 2}, {-2, 2}});
  const Coverage coverage = coverageOf(takeSnapshot(sceneWith(dome), 0, {1280, 720}));
  EXPECT_GT(coverage.larger(), 0.83);
  EXPECT_LT(coverage.larger(), 0.88) << "samples, a 64th of the radius apart, may end before the border";
}

TEST(FittedCamera, NothingAndPointsAndHugeScenesWork) {
  const auto view = [](const Scene& scene) { return takeSnapshot(scene, 0, {10, 10}).view; };
  EXPECT_NO_THROW((void)view(Scene{}));
  Scene point;
  point.add(Node{.translation = Vec3(7), .scale = Vec3(0), .surface = sphere(1)});
  EXPECT_NO_THROW((void)view(point));
  Scene far;
  far.add(Node{.translation = Vec3(1e9), .surface = sphere(1)});
  EXPECT_NO_THROW((void)view(far));
  Scene line;  // toward the eye
  line.add(Node{.rotation = Rotation{glm::cross(Vec3(0, 0, 1), unit(kFittedDirection)),
                                     std::acos(unit(kFittedDirection).z)},
                .scale = Vec3(0, 0, 1),
                .surface = sphere(1)});
  EXPECT_GT(glm::dot(view(line).eye, unit(kFittedDirection)), 1);
}

}  // namespace
}  // namespace luxo
