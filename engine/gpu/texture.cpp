// SPDX-License-Identifier: Apache-2.0
#include "gpu/texture.h"

#include "base/assert.h"
#include "gpu/debug.h"
#include "gpu/result.h"

#include <fmt/format.h>

#include <utility>

namespace luxo::gpu {
namespace {

Allocation allocateFor(Context& context, VkImage image) {
  VkMemoryDedicatedRequirements dedicated{.sType = VK_STRUCTURE_TYPE_MEMORY_DEDICATED_REQUIREMENTS};
  VkMemoryRequirements2 requirements{.sType = VK_STRUCTURE_TYPE_MEMORY_REQUIREMENTS_2, .pNext = &dedicated};
  const VkImageMemoryRequirementsInfo2 info{.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_REQUIREMENTS_INFO_2,
                                            .image = image};
  vkGetImageMemoryRequirements2(context.device(), &info, &requirements);
  return context.memory().allocate(
      {.requirements = requirements.memoryRequirements,
       .use = MemoryUse::Device,
       .tiling = Tiling::Optimal,
       .dedicatedImage = dedicated.prefersDedicatedAllocation ? image : VK_NULL_HANDLE});
}

Handle<VkImageView> createView(Context& context, VkImage image, VkFormat format) {
  const VkImageViewCreateInfo info{
      .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
      .image = image,
      .viewType = VK_IMAGE_VIEW_TYPE_2D,
      .format = format,
      .subresourceRange = {.aspectMask = aspectOf(format), .levelCount = 1, .layerCount = 1}};
  VkImageView view = VK_NULL_HANDLE;
  check(vkCreateImageView(context.device(), &info, nullptr, &view), "create a view of a texture");
  return {context, view};
}

// Images that are only copied may not have views.
constexpr VkImageUsageFlags kViewed = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_STORAGE_BIT |
                                      VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                                      VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;

}  // namespace

VkImageAspectFlags aspectOf(VkFormat format) noexcept {
  switch (format) {
    case VK_FORMAT_D16_UNORM:
    case VK_FORMAT_D32_SFLOAT:
      return VK_IMAGE_ASPECT_DEPTH_BIT;
    default:
      return VK_IMAGE_ASPECT_COLOR_BIT;
  }
}

std::uint32_t bytesPerTexel(VkFormat format) {
  switch (format) {
    case VK_FORMAT_R8G8B8A8_UNORM:
    case VK_FORMAT_R8G8B8A8_SRGB:
    case VK_FORMAT_B8G8R8A8_UNORM:
    case VK_FORMAT_B8G8R8A8_SRGB:
    case VK_FORMAT_R32_SFLOAT:
    case VK_FORMAT_R32_UINT:
    case VK_FORMAT_D32_SFLOAT:
      return 4;
    case VK_FORMAT_R16G16B16A16_SFLOAT:
    case VK_FORMAT_R32G32_SFLOAT:
      return 8;
    case VK_FORMAT_R32G32B32A32_SFLOAT:
    case VK_FORMAT_R32G32B32A32_UINT:
      return 16;
    default:
      LUXO_REQUIRE(!"a format whose size luxo knows");
      return 0;
  }
}

Texture::Texture(Context& context, const TextureDesc& desc)
    : extent_(desc.extent), format_(desc.format), samples_(desc.samples) {
  const std::uint32_t largest = context.limits().maxImageDimension2D;
  for (const std::uint32_t size : {extent_.width, extent_.height}) {
    LUXO_REQUIRE_COMPARE(size, >, 0u);
    LUXO_REQUIRE_COMPARE(size, <=, largest);
  }
  const VkImageCreateInfo info{.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                               .imageType = VK_IMAGE_TYPE_2D,
                               .format = desc.format,
                               .extent = {extent_.width, extent_.height, 1},
                               .mipLevels = 1,
                               .arrayLayers = 1,
                               .samples = desc.samples,
                               .tiling = VK_IMAGE_TILING_OPTIMAL,
                               .usage = desc.usage};
  VkImage image = VK_NULL_HANDLE;
  const std::string attempted =
      fmt::format("create the texture \"{}\" of {}x{} pixels and {} samples", desc.name, extent_.width,
                  extent_.height, static_cast<int>(desc.samples));
  check(vkCreateImage(context.device(), &info, nullptr, &image), attempted);
  image_ = {context, image};
  image_.own(allocateFor(context, image));
  const Allocation& memory = image_.memory();
  check(vkBindImageMemory(context.device(), image, memory.memory, memory.offset), attempted);
  setName(context, image, desc.name);
  if ((desc.usage & kViewed) == 0) return;
  view_ = createView(context, image, format_);
  setName(context, static_cast<VkImageView>(view_), desc.name);
}

Texture& Texture::operator=(Texture&& other) noexcept {
  if (this == &other) return *this;
  view_ = std::move(other.view_);
  image_ = std::move(other.image_);
  extent_ = other.extent_;
  format_ = other.format_;
  samples_ = other.samples_;
  state_ = other.state_;
  return *this;
}

Handle<VkSampler> createSampler(Context& context, VkFilter filter) {
  const VkSamplerCreateInfo info{.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
                                 .magFilter = filter,
                                 .minFilter = filter,
                                 .addressModeU = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                 .addressModeV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                 .addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE};
  VkSampler sampler = VK_NULL_HANDLE;
  check(vkCreateSampler(context.device(), &info, nullptr, &sampler), "create a sampler");
  return {context, sampler};
}

}  // namespace luxo::gpu
