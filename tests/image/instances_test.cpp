// SPDX-License-Identifier: Apache-2.0
// Nodes of one shape share a shell: few draws, and the same picture.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "luxo_grandpa/lamp.h"
#include "support/picture.h"
#include "surface/catalogue.h"

namespace luxo::test {
namespace {

class InstancesTest : public PictureTest {
 protected:
  /// So many of each shape in a cloud, in so many materials.
  static Snapshot cloud(std::initializer_list<const char*> shapes, int count, PixelSize size,
                        double scale = 1, int materialCount = 4) {
    Scene scene;
    std::vector<MaterialId> materials;
    for (int i = 0; i < materialCount; ++i)
      materials.push_back(scene.add(
          Material{.name = "m" + std::to_string(i), .diffuse = Vec3(0.2 + 0.8 * i / materialCount)}));
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
                       .material = materials[static_cast<std::size_t>(i) % materials.size()]});
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
// materials; of those with a second side each twice, and what the picture's edge cuts by itself. Few are
// drawn by themselves as they are large.
TEST_F(InstancesTest, QuadricsShareTheirDraws) {
  expectTheSamePicture(cloud({"sphere"}, 600, {320, 200}), 7 * 4 * 2 + 4);
  expectTheSamePicture(cloud({"cylinder", "paraboloid"}, 300, {320, 200}), 2 * 7 * 4 * 2);
}

TEST_F(InstancesTest, FormulasShareTheirDraws) {
  expectTheSamePicture(cloud({"torus", "klein_figure8"}, 250, {320, 200}, 0.15), 2 * 2 * 4 * 2);
}

// Of what is small draws are counted by levels, not by nodes: distances from 12 to 52 metres are at most 7 of
// them, and nodes at the picture's edge have draws of their own. Materials are data. What rays find is a draw
// for each node that they find it of.
TEST_F(InstancesTest, TenThousandSpheresOfEightMaterialsAreAtMostSixtyDraws) {
  const Picture picture =
      renderer().render(cloud({"sphere"}, 10'000, {1280, 720}, 0.15, 8), {.audit = {AuditExtent::None}});
  EXPECT_GT(picture.statistics.count.drawn, 5000U);
  EXPECT_LE(picture.statistics.count.drawCalls, 60U);
  EXPECT_EQ(picture.statistics.error.unconvergedPx, 0U);
}

/// Ten thousand lamps of the same parts, each in its own pose, seen from 60 metres above.
Scene tenThousandLamps() {
  constexpr int kSide = 100;
  constexpr double kSpacing = 6;
  const Scene one = luxoGrandpa();
  Scene scene;
  for (std::size_t i = 1; i < one.materials().size(); ++i) scene.add(one.materials()[i]);
  for (int lamp = 0; lamp < kSide * kSide; ++lamp) {
    const NodeId place = scene.add(
        Node{.translation = Vec3((lamp % kSide - kSide / 2) * kSpacing, 0, -(lamp / kSide) * kSpacing),
             .rotation = Rotation{.axis = Vec3(0, 1, 0), .angle = 0.37 * lamp}});
    std::vector<NodeId> copies;
    for (const Scene::Entry& entry : one.nodes()) {
      Node part = entry.node;
      part.parent = part.parent.valid() ? copies.at(part.parent.index) : place;
      part.light.reset();
      if (part.name == "floor") part.surface = Surface{};
      copies.push_back(scene.add(std::move(part)));
    }
  }
  scene.add(Node{.translation = Vec3(8, 140, 60), .light = Light{}});
  scene.add(Camera{.eye = Vec3(0, 60, 60), .lookAt = Vec3(0, 0, -60), .fovY = radians(50)});
  return scene;
}

// Five shapes at up to 9 levels, which are a root of 2 apart; of the rods, which show their front alone, and
// of the shade two sides each; and, as above, what the picture's edge cuts by itself.
TEST_F(InstancesTest, TenThousandLampsAreAtMost150Draws) {
  const Picture picture =
      renderer().render(takeSnapshot(tenThousandLamps(), 21, {1280, 720}), {.audit = {AuditExtent::None}});
  EXPECT_GT(picture.statistics.count.instances, 60'000U);
  EXPECT_LE(picture.statistics.count.drawCalls, 150U);
  EXPECT_EQ(picture.statistics.error.unconvergedPx, 0U);
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
