// SPDX-License-Identifier: Apache-2.0
#include "gpu/whole_target.h"

#include <cstdint>

#include "gpu/barrier.h"
#include "gpu/texture.h"

namespace luxo::gpu {

std::vector<Readback> drawWholeTargets(
    Context& context, const GraphicsPipeline& pipeline, VkExtent2D extent, VkFormat format, std::size_t count,
    const std::function<void(FrameRing& frames, VkCommandBuffer commands)>& bind) {
  std::vector<Texture> targets;
  std::vector<VkRenderingAttachmentInfo> attachments;
  FrameRing frames(context);
  const VkCommandBuffer commands = frames.begin();
  for (std::size_t k = 0; k < count; ++k) {
    Texture& target = targets.emplace_back(
        context, TextureDesc{.extent = extent,
                             .format = format,
                             .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                             .name = "values"});
    use(commands, {{target, Use::ColorAttachment, Contents::Discard}});
    attachments.push_back({.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                           .imageView = target.view(),
                           .imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                           .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
                           .storeOp = VK_ATTACHMENT_STORE_OP_STORE});
  }
  const VkRenderingInfo rendering{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                                  .renderArea = {.extent = extent},
                                  .layerCount = 1,
                                  .colorAttachmentCount = static_cast<std::uint32_t>(count),
                                  .pColorAttachments = attachments.data()};
  vkCmdBeginRendering(commands, &rendering);
  setViewport(commands, extent);
  pipeline.bind(commands);
  if (bind) bind(frames, commands);
  vkCmdSetCullMode(commands, VK_CULL_MODE_NONE);
  vkCmdSetFrontFace(commands, VK_FRONT_FACE_COUNTER_CLOCKWISE);
  vkCmdDraw(commands, 3, 1, 0, 0);
  vkCmdEndRendering(commands);
  std::vector<Readback> readbacks;
  for (Texture& target : targets) readbacks.emplace_back(context, extent, format).record(commands, target);
  frames.wait(frames.submit());
  return readbacks;
}

}  // namespace luxo::gpu
