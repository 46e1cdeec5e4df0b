// SPDX-License-Identifier: Apache-2.0
// From a picture on the device to the window: encodes it as sRGB, writes text over it, hands it over.
#pragma once

#include "gpu/context.h"
#include "gpu/descriptor.h"
#include "gpu/frame.h"
#include "gpu/handle.h"
#include "gpu/pipeline.h"
#include "gpu/texture.h"
#include "window/overlay.h"
#include "window/swapchain.h"

#include <span>
#include <vector>

namespace luxo::window {

class Presenter {
 public:
  Presenter(gpu::Context& context, VkFormat windowFormat);

  /// Records into the ring's open recording. `picture` is scene-linear, may be sampled and has the size of
  /// the swapchain (required), whose acquired image it fills. Gives the panels' grab areas.
  [[nodiscard]] std::vector<GrabArea> record(gpu::FrameRing& frames, VkCommandBuffer commands,
                                             gpu::Texture& picture, Swapchain& swapchain, double contentScale,
                                             std::span<const Panel> panels);

 private:
  void show(gpu::FrameRing& frames, VkCommandBuffer commands, const gpu::Texture& picture,
            const Swapchain& swapchain);

  gpu::Context* context_;
  gpu::DescriptorLayout layout_;
  gpu::Handle<VkSampler> sampler_;
  gpu::GraphicsPipeline pipeline_;
  Overlay overlay_;
};

}  // namespace luxo::window
