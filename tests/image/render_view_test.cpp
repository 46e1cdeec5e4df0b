// SPDX-License-Identifier: Apache-2.0
// Views as values: pictures overlap on the device, and several views share one painter.
#include "draw/render_view.h"

#include <gtest/gtest.h>

#include <cstring>
#include <deque>
#include <vector>

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

}  // namespace
}  // namespace luxo::test
