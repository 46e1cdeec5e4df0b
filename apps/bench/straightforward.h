// SPDX-License-Identifier: Apache-2.0
// The path every claim is measured against: the lamp drawn the way a textbook draws it. Every surface 64 x
// 64, one draw per strip, all uniforms set again for each object, floor first, depth test on, culling off.
// What surrounds the drawing (device, memory, pipelines, frames) is the engine's own, so that only the
// strategy differs.
#pragma once

#include <array>
#include <cstdint>

#include "gpu/buffer.h"
#include "gpu/context.h"
#include "gpu/descriptor.h"
#include "gpu/frame.h"
#include "gpu/pipeline.h"
#include "plain_targets.h"
#include "scene/camera.h"
#include "textbook_lamp.h"

namespace luxo::bench {

class Straightforward {
 public:
  Straightforward(gpu::Context& context, PixelSize size, VkFormat colorFormat);

  /// Records the lamp at a time. Scene-linear RGBA in target() once the recording is complete.
  void record(gpu::FrameRing& frames, VkCommandBuffer commands, float time);

  [[nodiscard]] gpu::Texture& target() { return targets_.color(); }
  [[nodiscard]] std::uint32_t triangles() const;
  [[nodiscard]] std::uint32_t drawCalls() const;

 private:
  struct DrawnObject {
    Object object;
    gpu::Buffer vertices;
  };

  void draw(VkCommandBuffer commands, const ParamSurface& geometry) const;

  float aspect_;
  std::vector<DrawnObject> objects_;
  VkDeviceSize uniformStride_;
  std::array<gpu::Buffer, gpu::FrameRing::kFrames> uniforms_;
  gpu::DescriptorLayout layout_;
  gpu::GraphicsPipeline pipeline_;
  PlainTargets targets_;
};

}  // namespace luxo::bench
