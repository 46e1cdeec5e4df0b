// SPDX-License-Identifier: Apache-2.0
// Views as values: pictures overlap on the device, and several views share one painter.
#include "draw/render_view.h"

#include <gtest/gtest.h>

#include <cstring>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "draw/scene_painter.h"
#include "gpu/transfer.h"
#include "luxo_grandpa/lamp.h"
#include "support/picture.h"

namespace luxo::test {
namespace {

constexpr PixelSize kRenderViewSize{160, 120};

class RenderViewTest : public PictureTest {
 protected:
  /// Without the audit and its rays, and with the skip of what is the same switched on and off.
  static DrawOptions options(Shading shading, bool unchanged = true) {
    DrawOptions options{.shading = shading, .audit = {.extent = AuditExtent::None}};
    options.skips.unchanged = unchanged;
    return options;
  }

  static std::vector<float> colors(gpu::Readback& readback) {
    std::vector<float> colors;
    for (int y = 0; y < kRenderViewSize.height; ++y)
      for (int x = 0; x < kRenderViewSize.width; ++x) {
        float texel[4];
        std::memcpy(
            texel,
            readback.row(static_cast<std::uint32_t>(y)).data() + sizeof texel * static_cast<std::size_t>(x),
            sizeof texel);
        colors.insert(colors.end(), texel, texel + 3);
      }
    return colors;
  }

  [[nodiscard]] gpu::Readback readback() {
    return {context(), {kRenderViewSize.width, kRenderViewSize.height}, VK_FORMAT_R32G32B32A32_SFLOAT};
  }
};

// What the host writes for the next picture is not what the device still reads for the last one.
TEST_F(RenderViewTest, PicturesOverlapOnTheDevice) {
  for (const Shading shading : {Shading::Exact, Shading::Phong})
    for (const bool unchanged : {true, false}) {
      gpu::FrameRing frames(context());
      ScenePainter painter(context());
      RenderView view(context(), Precision::Full);
      std::deque<gpu::Readback> pictures;
      std::vector<Snapshot> snapshots;
      std::uint64_t last = 0;
      for (int k = 0; k < 6; ++k) {
        snapshots.push_back(takeSnapshot(luxoGrandpa(), 3.0 * k, kRenderViewSize));
        const VkCommandBuffer commands = frames.begin();
        FrameStatistics statistics;
        painter.record(frames, commands, view, snapshots.back(), options(shading, unchanged), statistics);
        pictures.push_back(readback());
        pictures.back().record(commands, view.picture());
        last = frames.submit();
      }
      frames.wait(last);
      for (std::size_t k = 0; k < snapshots.size(); ++k) {
        Renderer alone(context());
        const Picture expected = alone.render(snapshots[k], options(shading));
        const auto samples = expected.image.samples();
        EXPECT_EQ(expected.statistics.error.resolvedByRaysPx, 0u) << "or they would differ";
        EXPECT_EQ(colors(pictures[k]), std::vector<float>(samples.begin(), samples.end())) << k;
      }
    }
}

TEST_F(RenderViewTest, ViewsOfOnePainterDoNotDisturbEachOther) {
  gpu::FrameRing frames(context());
  ScenePainter painter(context());
  RenderView left(context(), Precision::Full), right(context(), Precision::Full);
  const Snapshot a = takeSnapshot(luxoGrandpa(), 21, kRenderViewSize),
                 b = takeSnapshot(luxoGrandpa(), 4, kRenderViewSize);
  gpu::Readback ofLeft = readback(), ofRight = readback();
  const VkCommandBuffer commands = frames.begin();
  FrameStatistics statistics;
  painter.record(frames, commands, left, a, options(Shading::Exact), statistics);
  painter.record(frames, commands, right, b, options(Shading::Exact), statistics);
  ofLeft.record(commands, left.picture());
  ofRight.record(commands, right.picture());
  frames.wait(frames.submit());
  const auto same = [&](gpu::Readback& picture, const Snapshot& snapshot) {
    const Picture expected = renderer().render(snapshot, options(Shading::Exact));
    const auto samples = expected.image.samples();
    return colors(picture) == std::vector<float>(samples.begin(), samples.end());
  };
  EXPECT_TRUE(same(ofLeft, a));
  EXPECT_TRUE(same(ofRight, b));
}

/// And whoever reads them sees light that is wrong.
TEST_F(RenderViewTest, ProbesTellTheColorsOfThePicture) {
  const Snapshot snapshot = takeSnapshot(luxoGrandpa(), 21, kRenderViewSize);
  for (const Precision precision : {Precision::Full, Precision::Half})
    for (const AuditExtent extent : {AuditExtent::Usual, AuditExtent::All}) {
      const DrawOptions options{.audit = {.extent = extent}};
      gpu::FrameRing frames(context());
      ScenePainter painter(context());
      RenderView view(context(), precision);
      const VkCommandBuffer commands = frames.begin();
      FrameStatistics statistics;
      painter.record(frames, commands, view, snapshot, options, statistics);
      frames.wait(frames.submit());
      std::vector<DepthProbe> probes = view.probes();
      ASSERT_GE(probes.size(), 64U);
      CertifiedRays rays;
      rays.begin(snapshot, options);
      EXPECT_EQ(rays.audit(probes, RayDraws(view.list()), view.shown()).failed, 0U);
      for (DepthProbe& probe : probes) {
        ASSERT_TRUE(probe.color);
        *probe.color += Vec3f(0, 0.01f, 0);
      }
      // But for outlines and borders of shadows.
      EXPECT_GT(rays.audit(probes, RayDraws(view.list()), view.shown()).failed, probes.size() * 9 / 10);
    }
}

Scene ballLitBy(const std::string& text, int lights = 1) {
  Scene scene;
  const MaterialShader shader{{{"ball.frag", text}}};
  scene.add(Node{.surface = sphere(1),
                 .material = scene.add(Material{.shader = std::make_shared<const MaterialShader>(shader)})});
  for (int i = 0; i < lights; ++i)
    scene.add(Node{.translation = Vec3(3, 4, i), .light = Light{.shadow = Light::Shadow::Exact}});
  return scene;
}

const Camera kBeforeBall{.eye = Vec3(0, 0, 4)};

// What cannot be drawn turns out when its draws are listed: too many lights for a shader.
TEST_F(RenderViewTest, WhatIsRefusedLeavesTheViewAsItWas) {
  gpu::FrameRing frames(context());
  ScenePainter painter(context());
  RenderView view(context(), Precision::Full);
  const auto record = [&](const Scene& scene) {
    const VkCommandBuffer commands = frames.begin();
    FrameStatistics statistics;
    painter.record(frames, commands, view, takeSnapshot(scene, 0, kRenderViewSize, kBeforeBall),
                   options(Shading::Exact), statistics);
    gpu::Readback picture = readback();
    picture.record(commands, view.picture());
    frames.wait(frames.submit());
    return colors(picture);
  };
  const Scene good = ballLitBy("vec4 material(Point p) { return vec4(0.5 * p.normal + 0.5, 1.0); }"),
              bad = ballLitBy("vec4 material(Point p) { return vec4(1.0); }", 40);
  const std::vector<float> first = record(good);
  const std::size_t instances = view.list().instances.size();
  EXPECT_THROW(static_cast<void>(record(bad)), Error);
  EXPECT_EQ(view.list().instances.size(), instances);
  EXPECT_EQ(view.options(), options(Shading::Exact));
  gpu::Readback picture = readback();
  picture.record(frames.begin(), view.picture());
  frames.wait(frames.submit());
  EXPECT_EQ(colors(picture), first) << "it is still there";
  EXPECT_EQ(record(good), first);
}

TEST_F(RenderViewTest, FaultsOfShadersAreCounted) {
  gpu::FrameRing frames(context());
  ScenePainter painter(context());
  RenderView view(context(), Precision::Half);
  const auto faults = [&](const std::string& text, Composition composition) {
    FrameStatistics statistics;
    DrawOptions drawn = options(Shading::Exact);
    drawn.composition = composition;
    painter.record(frames, frames.begin(), view,
                   takeSnapshot(ballLitBy(text, 1), 0, kRenderViewSize, kBeforeBall), drawn, statistics);
    frames.wait(frames.submit());
    return view.shaderFaults();
  };
  for (const Composition composition : {Composition::Auto, Composition::Deferred}) {
    const auto none = faults("vec4 material(Point p) { return vec4(1); }", composition),
               endless = faults(
                   "vec4 material(Point p) { float x = 0.0; while (x < 1.0) x *= 0.5; return vec4(x); }",
                   composition),
               through = faults("vec4 material(Point p) { return vec4(1, 1, 1, 0.5); }", composition);
    EXPECT_EQ(none.endless + none.seenThrough + none.moved + none.manyTraces, 0u);
    EXPECT_GT(endless.endless, 0u);
    EXPECT_GT(through.seenThrough, 3000u) << "pixels of the ball";
  }
}

}  // namespace
}  // namespace luxo::test
