// SPDX-License-Identifier: Apache-2.0
// Pictures with many samples per pixel: one pass per sample, each sampled elsewhere in the pixels, and their
// mean.
#pragma once

#include <vector>

#include "gpu/context.h"
#include "gpu/descriptor.h"
#include "gpu/frame.h"
#include "gpu/pipeline.h"
#include "gpu/texture.h"
#include "math/vec.h"

namespace luxo {

/// Where passes sample the pixels, in pixels from their centres, x right, y down: View::sampleOffsetPx. The
/// first `samples` points of M. Roberts' sequence R2 (2018), moved so that their mean is 0: what changes
/// evenly across a pixel comes out exact. The share of the points beyond a straight edge differs from the
/// area beyond it by less than 2 / samples^0.75, up to 256 samples. One sample is at the centre, and four
/// are where Vulkan has them in one pass (standardSampleLocations).
[[nodiscard]] std::vector<Vec2> samplePattern(int samples);

/// The running mean of pictures, on the device, in float: linear and unclamped.
class Accumulator {
 public:
  explicit Accumulator(gpu::Context& context);

  /// Records that `picture`, which may be sampled, joins the mean of `before` others; 0 begins anew, with
  /// the size of the picture. Rounding moves the mean by less than 1e-7 of it per picture.
  void add(gpu::FrameRing& frames, VkCommandBuffer commands, gpu::Texture& picture, int before);

  /// Scene-linear RGB, row 0 at the top; may be sampled and read back. alphaOf() tells the fourth value.
  [[nodiscard]] gpu::Texture& mean() { return mean_; }

  /// From the fourth value of the mean: that of the picture whose alpha was largest, or, where some were
  /// negative, the least; below 16 in magnitude (required), negative ones to 1e-6.
  [[nodiscard]] static float alphaOf(float meanAlpha) {
    return meanAlpha >= kUncertain ? kUncertain - meanAlpha : meanAlpha;
  }

 private:
  static constexpr float kUncertain = 16;

  gpu::Context* context_;
  gpu::DescriptorLayout layout_;
  gpu::Handle<VkSampler> sampler_;
  gpu::GraphicsPipeline pipeline_;
  gpu::Texture mean_;
};

}  // namespace luxo
