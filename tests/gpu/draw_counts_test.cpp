// SPDX-License-Identifier: Apache-2.0
// What a frame costs, as counts: the lamp is cheap, what is the same is not done again, and nothing piles up.
#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "cull/cull.h"
#include "draw/draw_list.h"
#include "luxo_grandpa/lamp.h"
#include "support/picture.h"
#include "surface/catalogue.h"

namespace luxo::test {
namespace {

using DrawCounts = PictureTest;

constexpr PixelSize kFull{1280, 720}, kTiny{64, 36};

TEST_F(DrawCounts, LampNeedsFewTrianglesAndDraws) {
  const Scene lamp = luxoGrandpa();
  for (int i = 0; i < 100; ++i) {
    // The counts do not depend on the picture being looked at: they are of the size asked for.
    const FrameStatistics statistics =
        draw(lamp, kFull, {.shading = Shading::Phong, .tolerancePx = 0.5}, 8 * kPi * i / 100).statistics;
    ASSERT_LT(statistics.count.triangles, 8000u) << "moment " << i;
    ASSERT_LE(statistics.count.drawCalls, 12u) << "moment " << i;
    ASSERT_EQ(statistics.count.nodes, 9u);
    ASSERT_EQ(statistics.count.submits, 1u);
    ASSERT_EQ(statistics.count.passes, 1u) << "nothing is transparent";
    ASSERT_LE(statistics.error.boundPx, 0.5) << "moment " << i;
  }
}

TEST_F(DrawCounts, StillFramesSubmitNothing) {
  const Scene lamp = luxoGrandpa();
  for (const int samples : {1, 4, 5})  // in one pass, in several
    for (const Output output : {Output::Color, Output::Position}) {
      const DrawOptions options{.output = output, .samples = samples};
      const Picture first = draw(lamp, kTiny, options, 21);
      EXPECT_GE(first.statistics.count.submits, 1u);
      const std::uint64_t before = context().counters().submits;
      for (int frame = 0; frame < 3; ++frame) {
        const Picture again = draw(lamp, kTiny, options, 21);
        EXPECT_TRUE(sameBytes(again.image, first.image)) << samples;
        const FrameCounts& count = again.statistics.count;
        EXPECT_EQ(count.submits + count.uploadBytes + count.drawCalls + count.triangles + count.passes, 0u);
        EXPECT_EQ(count.drawn, first.statistics.count.drawn) << "it shows what it showed";
        EXPECT_EQ(again.statistics.error.boundPx, first.statistics.error.boundPx);
        EXPECT_EQ(again.statistics.error.residualMaxPx, first.statistics.error.residualMaxPx);
        EXPECT_EQ(again.statistics.error.uncertifiedPx, first.statistics.error.uncertifiedPx);
      }
      EXPECT_EQ(context().counters().submits, before);
    }
}

TEST_F(DrawCounts, WhateverChangesIsDrawn) {
  Scene lamp = luxoGrandpa();
  const DrawOptions plain;
  const auto submits = [&](const DrawOptions& options, PixelSize size, double time) {
    return draw(lamp, size, options, time).statistics.count.submits;
  };
  EXPECT_GT(submits(plain, kTiny, 21), 0u);
  EXPECT_EQ(submits(plain, kTiny, 21), 0u);
  EXPECT_GT(submits({.tolerancePx = 0.25}, kTiny, 21), 0u);
  EXPECT_GT(submits(plain, kTiny, 21), 0u) << "the readback holds the other one";
  EXPECT_GT(submits(plain, {65, 36}, 21), 0u);
  EXPECT_GT(submits(plain, {65, 36}, 21.5), 0u);
  EXPECT_GT(submits({.skips = {.unchanged = false}}, {65, 36}, 21.5), 0u);
  EXPECT_GT(submits({.skips = {.unchanged = false}}, {65, 36}, 21.5), 0u) << "nothing may be left out";
  lamp.set(RenderSettings{.background = Vec3(1)});
  EXPECT_GT(submits(plain, {65, 36}, 21.5), 0u);
}

TEST_F(DrawCounts, GivenUpPicturesAreNotShownAgain) {
  const Snapshot snapshot = takeSnapshot(luxoGrandpa(), 21, kTiny);
  const DrawOptions several{.samples = 5};
  const Image whole = renderer().render(snapshot, several).image;
  static_cast<void>(renderer().render(snapshot));
  EXPECT_FALSE(renderer().render(snapshot, several, [](double done) { return done < 0.5; }));
  const Picture anew = renderer().render(snapshot, several);
  EXPECT_GT(anew.statistics.count.submits, 0u);
  EXPECT_TRUE(sameBytes(anew.image, whole));
}

TEST_F(DrawCounts, DrawnAgainNothingIsMadeAgain) {
  const Snapshot snapshot = takeSnapshot(luxoGrandpa(), 21, kFull);
  const FrameCounts first = renderer().render(snapshot).statistics.count;
  EXPECT_GT(first.uploadBytes, 0u);
  EXPECT_GT(first.tessellated, 0u);
  EXPECT_GT(first.pipelinesCreated, 0u);
  // Other options, so that it is drawn.
  const FrameCounts again = renderer().render(snapshot, {.skips = {.passes = false}}).statistics.count;
  EXPECT_GT(again.submits, 0u);
  EXPECT_EQ(again.uploadBytes, 0u);
  EXPECT_EQ(again.tessellated, 0u);
  EXPECT_EQ(again.pipelinesCreated, 0u);
  EXPECT_EQ(again.triangles, first.triangles);
  EXPECT_EQ(again.drawCalls, first.drawCalls);
}

TEST_F(DrawCounts, WhatSearchesLoseIsDrawnPixelByPixel) {
  // Searches that begin in some transversal triangles are lost. Rays find those points, of which each is a
  // triangle; the shell is not drawn again.
  Scene scene;
  scene.add(Node{.surface = makeSurface("teapot")});
  scene.add(Node{.translation = Vec3(3, 6, 4), .light = Light{}});
  scene.add(Camera{.eye = Vec3(-5.39, 4.71, 0.69), .lookAt = Vec3(0.22, 1.58, 0)});
  const DrawOptions options{.skips = {.hidden = false}};
  const Snapshot snapshot = takeSnapshot(scene, 0, {1280, 720});
  Geometry geometry;
  std::uint64_t once = 0;
  for (const DrawBatch& batch : listDraws(snapshot, cull(snapshot, {}), options, geometry).opaque)
    once += batch.indexCount / 3 * batch.instanceCount;

  const FrameStatistics picture = draw(scene, {1280, 720}, options).statistics;
  EXPECT_GT(picture.count.triangles, once);
  EXPECT_LE(picture.count.triangles, once + picture.error.resolvedByRaysPx);
  EXPECT_EQ(picture.error.unconvergedPx, 0u);
}

TEST_F(DrawCounts, WhatIsHiddenIsNotDrawn) {
  Scene front;
  front.add(Node{.surface = sphere(1)});
  front.add(Camera{.eye = Vec3(0, 0, 6)});
  const auto behind = [&](const Vec3& place) {
    Scene both = front;
    both.add(Node{.translation = place, .surface = sphere(0.9)});
    return both;
  };
  const auto countsOf = [&](const Scene& scene, bool hidden) {
    return draw(scene, {256, 256}, {.skips = {.hidden = hidden}}).statistics.count;
  };
  const std::uint64_t alone = countsOf(front, true).triangles;
  if (context().deviceInfo().type != gpu::DeviceType::Cpu) {
    EXPECT_EQ(countsOf(behind(Vec3(0, 0, -2)), true).culledHidden, 0U) << "a GPU does this itself";
    return;
  }
  const FrameCounts hidden = countsOf(behind(Vec3(0, 0, -2)), true),
                    drawn = countsOf(behind(Vec3(0, 0, -2)), false);
  EXPECT_LE(hidden.triangles, alone) << "where bodies hide each other, some are hidden by their own";
  EXPECT_EQ(hidden.triangles + hidden.culledHidden, drawn.triangles);
  EXPECT_EQ(drawn.culledHidden, 0U);
  EXPECT_GT(countsOf(behind(Vec3(1, 0, -2)), true).triangles, alone) << "half of it is seen";
  EXPECT_GT(countsOf(behind(Vec3(0, 0, 3)), true).triangles, alone) << "it is in front";
}

TEST_F(DrawCounts, MotionUploadsTransformsOnly) {
  // From infinitely far away, spinning bodies stay as large as they are: their levels do not change.
  Scene scene;
  scene.add(Node{.rotation = spin({1, 2, 3}, 1), .surface = sphere(1)});
  scene.add(Node{.translation = Vec3(2, 0, 0), .surface = torus(0.5, 0.2)});
  scene.add(Node{.translation = Vec3(1, 3, 4), .light = Light{}});
  scene.add(Camera{.eye = Vec3(0, 1, 6), .projection = Projection::Orthographic, .height = 4});
  const FrameCounts first = draw(scene, kTiny, {}, 0).statistics.count;
  for (int frame = 1; frame < 20; ++frame) {
    const FrameCounts count = draw(scene, kTiny, {}, frame / 24.0).statistics.count;
    ASSERT_EQ(count.tessellated, 0u) << frame;
    ASSERT_EQ(count.pipelinesCreated, 0u) << frame;
    ASSERT_GT(count.uploadBytes, 0u) << frame;
    ASSERT_LT(count.uploadBytes, first.uploadBytes / 2) << frame;
  }
}

TEST_F(DrawCounts, LevelsComeBackWithoutTessellation) {
  const Scene lamp = luxoGrandpa();
  for (int i = 0; i < 50; ++i) static_cast<void>(draw(lamp, kTiny, {}, 8 * kPi * i / 50));
  for (int i = 0; i < 50; ++i)
    ASSERT_EQ(draw(lamp, kTiny, {}, 8 * kPi * i / 50).statistics.count.tessellated, 0u) << "moment " << i;
}

TEST_F(DrawCounts, NothingPilesUp) {
  const Scene lamp = luxoGrandpa();
  constexpr std::array kShadings{Shading::Exact, Shading::Flat, Shading::Phong, Shading::Normal, Shading::Uv};
  const auto frame = [&](int i) {
    // Ten kinds of frames: moments, shadings, samples.
    static_cast<void>(
        draw(lamp, kTiny, {.shading = kShadings[i % 5], .samples = i % 2 ? 4 : 1}, 2.0 * (i % 10)));
  };
  for (int i = 0; i < 20; ++i) frame(i);
  context().waitIdle();
  const gpu::Counters before = context().counters();
  for (int i = 0; i < 1000; ++i) frame(i);
  context().waitIdle();
  const gpu::Counters after = context().counters();
  EXPECT_EQ(after.buffers, before.buffers);
  EXPECT_EQ(after.textures, before.textures);
  EXPECT_EQ(after.objects, before.objects);
  EXPECT_EQ(after.allocations, before.allocations);
  EXPECT_EQ(after.memoryBytes, before.memoryBytes);
  EXPECT_EQ(after.deviceAllocations, before.deviceAllocations);
  EXPECT_EQ(after.deviceBytes, before.deviceBytes);
  EXPECT_EQ(after.pipelinesCreated, before.pipelinesCreated);
  EXPECT_GE(after.submits, before.submits + 1000);
}

/// A ball, what else there is, and a light with exact shadows; the eye looks down from (0, 9, 5).
Scene ballAnd(const std::vector<Node>& others, const Vec3& light, const Vec3& lookAt = Vec3(0)) {
  Scene scene;
  scene.add(Node{.surface = sphere(1)});
  for (const Node& other : others) scene.add(other);
  scene.add(Node{.translation = light, .light = Light{.shadow = Light::Shadow::Exact}});
  scene.add(Camera{.eye = Vec3(0, 9, 5), .lookAt = lookAt});
  return scene;
}

TEST_F(DrawCounts, NoCasterIsLookedForThatShadowsNothingSeen) {
  // Maps, and draws that look for a caster.
  const auto looks = [](const Scene& scene) {
    Geometry geometry;
    const Snapshot snapshot = takeSnapshot(scene, 0, kTiny);
    const DrawList list = listDraws(snapshot, cull(snapshot, {}), {}, geometry);
    std::size_t draws = 0;
    for (const LightGroup& group : list.groups) draws += group.shadows.size();
    // What is known as an equation needs no map.
    EXPECT_EQ(list.casters.casters.size() + list.casters.closed.size(), draws);
    EXPECT_EQ(geometry.casters.made() > 0, !list.casters.casters.empty())
        << "what is not looked for is not made";
    return draws;
  };
  const auto ball = [](const Vec3& at) { return Node{.translation = at, .surface = sphere(1)}; };
  const Node floor{.translation = Vec3(0, -2, 0), .surface = rectangle(20, 20)};
  EXPECT_EQ(looks(ballAnd({floor}, {2, 5, 0})), 1U) << "onto the floor";
  EXPECT_EQ(looks(ballAnd({}, {2, 5, 0})), 0U) << "a ball alone";
  EXPECT_EQ(looks(ballAnd({ball({0, 0, 2.5})}, {0, 9, 1})), 0U) << "beside each other";
  EXPECT_EQ(looks(ballAnd({ball({0, 0, 2.5})}, {0, 0.5, 9})), 1U) << "one behind the other";
  EXPECT_EQ(looks(ballAnd({ball({0, 0, 2.5})}, {0, 0, 1.25})), 0U) << "on either side of the light";
  EXPECT_EQ(looks(ballAnd({floor}, {0, -1.5, 0})), 0U) << "above the light";
  EXPECT_EQ(looks(ballAnd({floor}, {30, 0, 0}, {0, 9, -5})), 0U) << "of the floor nothing is in the picture";
  EXPECT_EQ(looks(ballAnd({Node{.translation = Vec3(0, 0, 3), .surface = torus(0.8, 0.2)}}, {0, 9, 0})), 1U)
      << "a torus may be in its own shadow; in the ball's it is not";
  const Node sheet{.translation = Vec3(0, 0, -3), .surface = flag()};
  EXPECT_EQ(looks(ballAnd({sheet}, {0, 0.5, 9})), 2U) << "one has a map, and may be in its own shadow";
  EXPECT_EQ(draw(ballAnd({ball({0, 0, 2.5})}, {0, 9, 1}), kTiny).statistics.count.shadowPasses, 0U);
}

TEST_F(DrawCounts, ShadowsAreNotFoundAgain) {
  const Scene scene = ballAnd({Node{.translation = Vec3(0, -2, 0), .surface = rectangle(20, 20)},
                               Node{.translation = Vec3(1.5, 0, 0), .surface = torus(0.8, 0.2)}},
                              {2, 5, 0});
  const Picture first = draw(scene, kTiny);
  EXPECT_EQ(first.statistics.count.shadowPasses, 2U);
  const Picture still = draw(scene, kTiny);
  EXPECT_TRUE(sameBytes(still.image, first.image));
  EXPECT_EQ(still.statistics.count.submits + still.statistics.count.uploadBytes, 0U);
  // Drawn all the same, nothing is made or uploaded for it.
  const FrameCounts drawn = draw(scene, kTiny, {.skips = {.passes = false}}).statistics.count;
  EXPECT_GT(drawn.submits, 0U);
  EXPECT_EQ(drawn.tessellated + drawn.uploadBytes + drawn.pipelinesCreated, 0U);
}

TEST_F(DrawCounts, WhatIsOpaqueRunsNoPassOfWhatIsSeenThrough) {
  Scene opaque = ballAnd({Node{.translation = Vec3(0, -2, 0), .surface = rectangle(20, 20)}}, {2, 5, 0});
  const FrameCounts before = draw(opaque, kTiny).statistics.count;
  EXPECT_EQ(before.layerPoints, 0U);
  EXPECT_LE(before.passes, 3U) << "points, shadows, light";
  EXPECT_GT(before.passes, 0U);
  opaque.add(Node{.translation = Vec3(0, 2, 0),
                  .surface = sphere(0.3),
                  .material = opaque.add(Material{.opacity = 0.5})});
  const FrameCounts after = draw(opaque, kTiny).statistics.count;
  EXPECT_GT(after.layerPoints, 0U);
  EXPECT_GT(after.passes, before.passes);
}

TEST_F(DrawCounts, LightsThatReachNothingCostNothing) {
  const std::vector<Node> floor{Node{.translation = Vec3(0, -2, 0), .surface = rectangle(20, 20)}};
  const FrameCounts one = draw(ballAnd(floor, {2, 5, 0}), kTiny).statistics.count;
  Scene scene = ballAnd(floor, {2, 5, 0});
  for (int i = 0; i < 40; ++i)
    scene.add(Node{
        .translation = Vec3(i, 5, 1),
        .light = Light{.intensity = 0.0, .shadow = Light::Shadow::Exact, .radius = 0.1, .shadowSamples = 9}});
  const Picture many = draw(scene, kTiny);
  EXPECT_EQ(many.statistics.count.shadowPasses, one.shadowPasses);
  EXPECT_EQ(many.statistics.count.passes, one.passes);
  EXPECT_EQ(many.statistics.count.drawCalls, one.drawCalls);
  EXPECT_EQ(many.statistics.count.culledLights, 2U * 9 * 40) << "by each of two nodes";
  EXPECT_TRUE(sameBytes(many.image, draw(ballAnd(floor, {2, 5, 0}), kTiny).image));
}

}  // namespace
}  // namespace luxo::test
