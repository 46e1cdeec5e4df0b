// SPDX-License-Identifier: Apache-2.0
// Nodes of one shape share a shell: few draws, and the same picture.
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "support/picture.h"
#include "surface/catalogue.h"

namespace luxo::test {
namespace {

class InstancesTest : public PictureTest {
 protected:
  /// So many of each shape in a cloud, in 4 materials.
  static Snapshot cloud(std::initializer_list<const char*> shapes, int count, PixelSize size,
                        double scale = 1) {
    Scene scene;
    std::vector<MaterialId> materials;
    for (int i = 0; i < 4; ++i)
      materials.push_back(
          scene.add(Material{.name = "m" + std::to_string(i), .diffuse = Vec3(0.2 + 0.2 * i)}));
    std::mt19937 random(7);
    const auto between = [&](double low, double high) {
      return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
    };
    for (const char* shape : shapes) {
      const Surface surface = makeSurface(shape);
      for (int i = 0; i < count; ++i) {
        const double x = between(-14, 14), y = between(-8, 8), z = between(-40, 0);
        const double turn = between(0, 6);
        scene.add(Node{.translation = Vec3(x, y, z),
                       .rotation = Rotation{.axis = Vec3(1, 2, 3), .angle = turn},
                       .scale = Vec3(scale),
                       .surface = surface,
                       .material = materials[static_cast<std::size_t>(i) % 4]});
      }
    }
    scene.add(Node{.translation = Vec3(5, 20, 30), .light = Light{.intensity = 0.9}});
    scene.add(Camera{.eye = Vec3(0, 0, 12), .lookAt = Vec3(0, 0, 0)});
    return takeSnapshot(scene, 0, size);
  }

  void expectTheSamePicture(const Snapshot& snapshot, std::uint64_t mostDraws) {
    const Picture shared = renderer().render(snapshot, {}),
                  single = renderer().render(snapshot, {.shareShells = false});
    EXPECT_TRUE(std::ranges::equal(shared.image.samples(), single.image.samples()));
    EXPECT_EQ(shared.statistics.error.unconvergedPx, 0u);
    EXPECT_EQ(shared.statistics.error.auditFailedPx, 0u);
    // Points of rays are a draw for each node.
    EXPECT_LE(shared.statistics.count.drawCalls, mostDraws + shared.statistics.error.resolvedByRaysPx);
    EXPECT_EQ(shared.statistics.count.triangles, single.statistics.count.triangles);
    EXPECT_GT(single.statistics.count.drawCalls, 4 * mostDraws);
  }
};

// Distances from 12 to 52 metres are up to 7 levels of detail, each a root of 2 finer than the next, in four
// materials; of those with a second side each twice, and what the picture's edge cuts by itself. Few are drawn
// by themselves as they are large.
TEST_F(InstancesTest, QuadricsShareTheirDraws) {
  expectTheSamePicture(cloud({"sphere"}, 600, {320, 200}), 7 * 4 * 2 + 4);
  expectTheSamePicture(cloud({"cylinder", "paraboloid"}, 300, {320, 200}), 2 * 7 * 4 * 2);
}

TEST_F(InstancesTest, FormulasShareTheirDraws) {
  expectTheSamePicture(cloud({"torus", "klein_figure8"}, 250, {320, 200}, 0.15), 2 * 2 * 4 * 2);
}

// Beyond so many nodes large ones share draws, too: what 240 of them add are levels and materials, of which
// there are no more than of 60. A torus that is drawn by itself is two draws of each side at most, and with
// all in front has one.
TEST_F(InstancesTest, LargeOnesShareTheirDrawsBeyondSome) {
  DrawOptions few;
  few.skips.hidden = false;
  few.maxDrawnApart = 8;
  few.sharedPixels = 0;
  few.audit = {.atLeast = 4000};
  const std::uint64_t most = 2 * 8 + 7 * 4 * 2;
  for (const int count : {60, 240}) {
    const Snapshot snapshot = cloud({"torus"}, count, {320, 200});
    const Picture picture = renderer().render(snapshot, few);
    EXPECT_EQ(picture.statistics.error.auditFailedPx, 0u);
    EXPECT_LE(picture.statistics.count.drawCalls, most + picture.statistics.error.resolvedByRaysPx);
    DrawOptions all = few;
    all.maxDrawnApart = 1000;
    const Picture apart = renderer().render(snapshot, all);
    EXPECT_GT(apart.statistics.count.drawCalls, static_cast<std::uint64_t>(count));
    EXPECT_LE(largestDifference(apart.image, picture.image), 1e-4);
  }
}

// What is large is told apart triangle by triangle, hides what is behind it, and shares nothing by mistake.
TEST_F(InstancesTest, LargeAndSmallOnesTogether) {
  const Snapshot snapshot = cloud({"sphere", "torus"}, 60, {1024, 640});
  const Picture picture = renderer().render(snapshot, {.audit = {.atLeast = 4000}});
  EXPECT_EQ(picture.statistics.error.auditFailedPx, 0u);
  DrawOptions all;
  all.skips = Skips::none();
  const Picture whole = renderer().render(snapshot, all);
  EXPECT_LE(largestDifference(whole.image, picture.image), 1e-4);
  // GPUs leave what is hidden to the depth test.
  if (context().deviceInfo().type == gpu::DeviceType::Cpu) {
    EXPECT_GT(picture.statistics.count.culledHidden, 0u);
  }
}

}  // namespace
}  // namespace luxo::test
