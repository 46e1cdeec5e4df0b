// SPDX-License-Identifier: Apache-2.0
#include "window/presenter.h"

#include "base/assert.h"
#include "gpu/barrier.h"
#include "gpu/debug.h"
#include "shared/picture_set.h"

#include <luxo/shaders/present_frag.h>
#include <luxo/shaders/present_vert.h>

namespace luxo::window {

Presenter::Presenter(gpu::Context& context, VkFormat windowFormat)
    : context_(&context),
      layout_(context, {{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_SHADER_STAGE_FRAGMENT_BIT}}),
      sampler_(gpu::createSampler(context, VK_FILTER_NEAREST)),
      pipeline_(context, {.name = "present",
                          .vertexShader = luxo_present_vert,
                          .fragmentShader = luxo_present_frag,
                          .colors = {{windowFormat}},
                          .setLayouts = {layout_}}),
      overlay_(context, windowFormat) {}

std::vector<GrabArea> Presenter::record(gpu::FrameRing& frames, VkCommandBuffer commands,
                                        gpu::Texture& picture, Swapchain& swapchain, double contentScale,
                                        std::span<const Panel> panels) {
  LUXO_REQUIRE_COMPARE(picture.extent().width, ==, swapchain.extent().width);
  LUXO_REQUIRE_COMPARE(picture.extent().height, ==, swapchain.extent().height);
  using enum gpu::Use;
  const VkImage image = swapchain.image();
  gpu::use(commands,
           {{picture, SampledFragment}, {image, swapchain.state(), ColorAttachment, gpu::Contents::Discard}});
  show(frames, commands, picture, swapchain);
  std::vector<GrabArea> areas;
  if (!panels.empty()) {
    gpu::use(commands, {{image, swapchain.state(), ColorAttachment}});
    areas = overlay_.record(commands, swapchain, contentScale, panels);
  }
  gpu::use(commands, {{image, swapchain.state(), Present}});
  return areas;
}

void Presenter::show(gpu::FrameRing& frames, VkCommandBuffer commands, const gpu::Texture& picture,
                     const Swapchain& swapchain) {
  const gpu::Label label(*context_, commands, "present");
  const VkDescriptorSet set = frames.descriptors().write(layout_, {{picture, sampler_}});
  const VkRenderingAttachmentInfo color{.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                        .imageView = swapchain.view(),
                                        .imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                                        .loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
                                        .storeOp = VK_ATTACHMENT_STORE_OP_STORE};
  const VkRenderingInfo rendering{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                                  .renderArea = {{0, 0}, swapchain.extent()},
                                  .layerCount = 1,
                                  .colorAttachmentCount = 1,
                                  .pColorAttachments = &color};
  vkCmdBeginRendering(commands, &rendering);
  gpu::setViewport(commands, swapchain.extent());
  pipeline_.bind(commands);
  pipeline_.bindSet(commands, shared::kSetPicture, set);
  vkCmdSetCullMode(commands, VK_CULL_MODE_NONE);
  vkCmdSetFrontFace(commands, VK_FRONT_FACE_COUNTER_CLOCKWISE);
  vkCmdDraw(commands, 3, 1, 0, 0);
  vkCmdEndRendering(commands);
}

}  // namespace luxo::window
