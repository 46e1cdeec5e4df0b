// SPDX-License-Identifier: Apache-2.0
#include "plain_targets.h"

#include "gpu/barrier.h"
#include "gpu/pipeline.h"

namespace luxo::bench {

PlainTargets::PlainTargets(gpu::Context& context, VkExtent2D extent, VkFormat color, std::string_view name)
    : color_(context, {.extent = extent,
                       .format = color,
                       .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                       .name = name}),
      depth_(context, {.extent = extent,
                       .format = kDepth,
                       .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
                       .name = name}) {}

void PlainTargets::begin(VkCommandBuffer commands, float farthest) {
  using enum gpu::Use;
  gpu::use(commands, {{color_, ColorAttachment, gpu::Contents::Discard},
                      {depth_, DepthAttachment, gpu::Contents::Discard}});
  const VkRenderingAttachmentInfo color{.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                        .imageView = color_.view(),
                                        .imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                                        .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
                                        .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
                                        .clearValue = {.color = {{0.02f, 0.025f, 0.03f, 1}}}};
  const VkRenderingAttachmentInfo depth{.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                        .imageView = depth_.view(),
                                        .imageLayout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL,
                                        .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
                                        .storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
                                        .clearValue = {.depthStencil = {farthest, 0}}};
  const VkRenderingInfo rendering{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                                  .renderArea = {{0, 0}, color_.extent()},
                                  .layerCount = 1,
                                  .colorAttachmentCount = 1,
                                  .pColorAttachments = &color,
                                  .pDepthAttachment = &depth};
  vkCmdBeginRendering(commands, &rendering);
  gpu::setViewport(commands, color_.extent());
}

}  // namespace luxo::bench
