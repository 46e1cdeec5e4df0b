// SPDX-License-Identifier: Apache-2.0
// Frames as luxo draws them.
#pragma once

#include <vector>

#include "draw/renderer.h"
#include "gpu/frame.h"
#include "scene/snapshot.h"

namespace luxo::bench {

struct FrameDesc {
  PixelSize size;
  DrawOptions options{.shading = Shading::Phong};
  Precision precision = Precision::Full;
  std::vector<double> times{21};  ///< of the still picture
};

/// The engine's frames: everything from the scene to finished pixels.
class LuxoFrames {
 public:
  LuxoFrames(gpu::Context& context, const Scene& scene, const FrameDesc& desc)
      : scene_(scene), desc_(desc), frames_(context), painter_(context), view_(context, desc.precision) {}

  FrameStatistics draw(double time) {
    FrameStatistics statistics;
    const Snapshot snapshot = takeSnapshot(scene_, time, desc_.size);
    painter_.record(frames_, frames_.begin(), view_, snapshot, desc_.options, statistics);
    frames_.wait(frames_.submit());
    return statistics;
  }

 private:
  const Scene& scene_;
  FrameDesc desc_;
  gpu::FrameRing frames_;
  ScenePainter painter_;
  RenderView view_;
};

}  // namespace luxo::bench
