// SPDX-License-Identifier: Apache-2.0
#include "gpu/barrier.h"

#include "base/assert.h"

#include <algorithm>
#include <vector>

namespace luxo::gpu {
namespace {

VkImageMemoryBarrier2 imageBarrier(const Usage& usage, const Dependency& dependency) {
  return {.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
          .srcStageMask = dependency.sourceStages,
          .srcAccessMask = dependency.sourceAccesses,
          .dstStageMask = dependency.destinationStages,
          .dstAccessMask = dependency.destinationAccesses,
          .oldLayout = dependency.oldLayout,
          .newLayout = dependency.newLayout,
          .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
          .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
          .image = usage.image,
          .subresourceRange = {.aspectMask = usage.aspect, .levelCount = 1, .layerCount = 1}};
}

VkBufferMemoryBarrier2 bufferBarrier(const Usage& usage, const Dependency& dependency) {
  return {.sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER_2,
          .srcStageMask = dependency.sourceStages,
          .srcAccessMask = dependency.sourceAccesses,
          .dstStageMask = dependency.destinationStages,
          .dstAccessMask = dependency.destinationAccesses,
          .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
          .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
          .buffer = usage.buffer,
          .size = VK_WHOLE_SIZE};
}

}  // namespace

Usage::Usage(Texture& texture, Use nextUse, Contents nextContents)
    : image(texture),
      aspect(aspectOf(texture.format())),
      state(&texture.state()),
      use(nextUse),
      contents(nextContents) {}

Usage::Usage(Buffer& usedBuffer, Use nextUse)
    : buffer(usedBuffer), state(&usedBuffer.state()), use(nextUse) {}

Usage::Usage(VkImage usedImage, ResourceState& imageState, Use nextUse, Contents nextContents)
    : image(usedImage),
      aspect(VK_IMAGE_ASPECT_COLOR_BIT),
      state(&imageState),
      use(nextUse),
      contents(nextContents) {}

void use(VkCommandBuffer commands, std::span<const Usage> usages) {
  std::vector<VkImageMemoryBarrier2> images;
  std::vector<VkBufferMemoryBarrier2> buffers;
  for (auto usage = usages.begin(); usage != usages.end(); ++usage) {
    // The barriers of one command have no order among themselves.
    LUXO_REQUIRE(
        std::none_of(usages.begin(), usage, [&](const Usage& u) { return u.state == usage->state; }));
    const auto dependency = usage->state->advance(usage->use, usage->contents);
    if (!dependency) continue;
    if (usage->image != VK_NULL_HANDLE) {
      images.push_back(imageBarrier(*usage, *dependency));
    } else {
      buffers.push_back(bufferBarrier(*usage, *dependency));
    }
  }
  if (images.empty() && buffers.empty()) return;
  const VkDependencyInfo info{.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                              .bufferMemoryBarrierCount = static_cast<std::uint32_t>(buffers.size()),
                              .pBufferMemoryBarriers = buffers.data(),
                              .imageMemoryBarrierCount = static_cast<std::uint32_t>(images.size()),
                              .pImageMemoryBarriers = images.data()};
  vkCmdPipelineBarrier2(commands, &info);
}

}  // namespace luxo::gpu
