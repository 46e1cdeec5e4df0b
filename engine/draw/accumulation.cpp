// SPDX-License-Identifier: Apache-2.0
#include "draw/accumulation.h"

#include <bit>
#include <cmath>
#include <cstdint>

#include "base/assert.h"
#include "gpu/barrier.h"
#include "gpu/debug.h"
#include "luxo/shaders/average_frag.h"
#include "luxo/shaders/whole_target_vert.h"
#include "math/sampling.h"
#include "shared/picture_set.h"

namespace luxo {
namespace {

constexpr VkFormat kSumFormat = VK_FORMAT_R32G32B32A32_SFLOAT;

}  // namespace

std::vector<Vec2> samplePattern(int samples) {
  LUXO_REQUIRE_COMPARE(samples, >=, 1);
  std::vector<Vec2> points;
  if (samples == 4) {
    for (const Vec2& location : sampleLocations(4)) points.push_back(location - 0.5);
    return points;
  }
  Vec2 mean(0);
  for (int k = 0; k < samples; ++k) {
    const Vec2 point = quasirandomPoint(k) - 0.5;
    points.push_back(point);
    mean += point / static_cast<double>(samples);
  }
  for (Vec2& point : points) point -= mean;
  return points;
}

Accumulator::Accumulator(gpu::Context& context)
    : context_(&context),
      layout_(context, {{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_SHADER_STAGE_FRAGMENT_BIT}}),
      sampler_(gpu::createSampler(context, VK_FILTER_NEAREST)),
      pipeline_(context,
                {.name = "average",
                 .vertexShader = luxo_whole_target_vert,
                 .fragmentShader = luxo_average_frag,
                 .colors = {{kSumFormat, gpu::Blend::Mean}},
                 .specialization = {{shared::kConstantUncertain, std::bit_cast<std::uint32_t>(kUncertain)}},
                 .setLayouts = {layout_}}) {}

void Accumulator::add(gpu::FrameRing& frames, VkCommandBuffer commands, gpu::Texture& picture, int before) {
  const VkExtent2D extent = picture.extent();
  if (!mean_ || mean_.extent().width != extent.width || mean_.extent().height != extent.height) {
    LUXO_REQUIRE_COMPARE(before, ==, 0);
    mean_ = gpu::Texture(*context_, {.extent = extent,
                                     .format = kSumFormat,
                                     .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                                              VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
                                     .name = "mean"});
  }
  constexpr const char* kName = "average";
  frames.mark(kName);
  const gpu::Label label(*context_, commands, kName);
  const VkDescriptorSet set = frames.descriptors().write(layout_, {{picture, sampler_}});
  gpu::use(commands,
           {{picture, gpu::Use::SampledFragment},
            {mean_, gpu::Use::ColorAttachment, before == 0 ? gpu::Contents::Discard : gpu::Contents::Keep}});
  // The first picture replaces all there is, but times 0, which does not undo an infinity or a NaN.
  const VkRenderingAttachmentInfo color{
      .sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
      .imageView = mean_.view(),
      .imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
      .loadOp = before == 0 ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD,
      .storeOp = VK_ATTACHMENT_STORE_OP_STORE};
  const VkRenderingInfo rendering{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                                  .renderArea = {{0, 0}, extent},
                                  .layerCount = 1,
                                  .colorAttachmentCount = 1,
                                  .pColorAttachments = &color};
  vkCmdBeginRendering(commands, &rendering);
  gpu::setViewport(commands, extent);
  pipeline_.bind(commands);
  pipeline_.bindSet(commands, shared::kSetPicture, set);
  const float part = 1.0f / static_cast<float>(before + 1);
  const float constants[] = {part, part, part, part};
  vkCmdSetBlendConstants(commands, constants);
  vkCmdSetCullMode(commands, VK_CULL_MODE_NONE);
  vkCmdSetFrontFace(commands, VK_FRONT_FACE_COUNTER_CLOCKWISE);
  vkCmdDraw(commands, 3, 1, 0, 0);
  vkCmdEndRendering(commands);
}

}  // namespace luxo
