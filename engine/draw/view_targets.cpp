// SPDX-License-Identifier: Apache-2.0
#include "draw/view_targets.h"

#include <algorithm>
#include <bit>

#include "base/assert.h"

namespace luxo {
namespace {

bool fits(const gpu::Texture& texture, VkExtent2D extent, VkSampleCountFlagBits samples) {
  return texture && texture.extent().width == extent.width && texture.extent().height == extent.height &&
         texture.samples() == samples;
}

constexpr VkFormat kFoundFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr VkFormat kFoundParametersFormat = VK_FORMAT_R32G32_SFLOAT;
constexpr VkFormat kFoundFootprintFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr VkFormat kFoundFrameFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr VkFormat kPlacesFormat = VK_FORMAT_R32G32B32A32_UINT;
constexpr VkFormat kShadowsFormat = VK_FORMAT_R32_UINT;
constexpr VkFormat kOpennessFormat = VK_FORMAT_R32_SFLOAT;
constexpr VkFormat kTransmittanceFormat = VK_FORMAT_R32G32B32A32_SFLOAT;

constexpr VkImageUsageFlags kReadAgain = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;

}  // namespace

VkFormat formatOf(Target target, const PictureFormat& picture) {
  switch (target) {
    case Target::Depth:
    case Target::LightDepth:
      return picture.depth;
    case Target::Found:
      return kFoundFormat;
    case Target::FoundParameters:
      return kFoundParametersFormat;
    case Target::FoundFootprint:
      return kFoundFootprintFormat;
    case Target::FoundFrame:
      return kFoundFrameFormat;
    case Target::Places:
      return kPlacesFormat;
    case Target::Shadows:
      return kShadowsFormat;
    case Target::Transmittance:
      return kTransmittanceFormat;
    case Target::Openness:
      return kOpennessFormat;
    case Target::MoreLight:
    case Target::Color:
      break;
  }
  return picture.color;
}

ViewTargets::ViewTargets(gpu::Context& context, Precision precision)
    : context_(&context),
      format_{.color = precision == Precision::Full ? VK_FORMAT_R32G32B32A32_SFLOAT
                                                    : VK_FORMAT_R16G16B16A16_SFLOAT} {}

void ViewTargets::prepare(VkExtent2D extent, VkSampleCountFlagBits samples, const Needs& needs) {
  format_.samples = samples;
  if (!fits(color_, extent, samples)) makePicture(extent);
  if (needs.deferred) LUXO_REQUIRE_COMPARE(samples, ==, VK_SAMPLE_COUNT_1_BIT);
  makeLightDepth(needs.lightDepth);
  const auto ensure = [&](bool needed, gpu::Texture& texture, Target target, const char* name,
                          VkImageUsageFlags more = 0) {
    if (!needed || fits(texture, extent, VK_SAMPLE_COUNT_1_BIT)) return;
    texture = gpu::Texture(*context_, {.extent = extent,
                                       .format = formatOf(target, format_),
                                       .usage = kReadAgain | more,
                                       .samples = samples,
                                       .name = name});
  };
  const auto ensureSlots = [&](std::uint32_t needed, std::vector<gpu::Texture>& textures, Target target,
                               const char* name) {
    textures.resize(std::max<std::size_t>(textures.size(), std::bit_width(needed)));
    for (std::size_t slot = 0; slot < textures.size(); ++slot)
      ensure((needed >> slot & 1) != 0, textures[slot], target, name, VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
  };
  ensureSlots(needs.shadows, shadows_, Target::Shadows, "shadows");
  ensureSlots(needs.transmittances, transmittances_, Target::Transmittance, "transmittance");
  ensure(needs.openness, openness_, Target::Openness, "openness");
  ensure(needs.moreLight, moreLight_, Target::MoreLight, "light of more lights");
  ensure(needs.footprints, foundFootprint_, Target::FoundFootprint, "footprints of what is found");
  ensure(needs.frames, foundFrame_, Target::FoundFrame, "frames of what is found");
  ensure(needs.deferred, found_, Target::Found, "found");
  ensure(needs.deferred, foundParameters_, Target::FoundParameters, "parameters of what is found");
  ensure(needs.shadows != 0 && needs.places, places_, Target::Places, "places of meshes");
  if (needs.shadows != 0 && !places_)
    places_ = gpu::Texture(
        *context_,
        {.extent = {1, 1}, .format = kPlacesFormat, .usage = kReadAgain, .name = "no places of meshes"});
}

/// Of the format's samples. Whatever has its pixels is made anew, too.
void ViewTargets::makePicture(VkExtent2D extent) {
  constexpr VkImageUsageFlags kDrawnOnly = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT,
                              kPicture = kReadAgain | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
  const auto make = [&](VkFormat format, VkImageUsageFlags usage, VkSampleCountFlagBits samples,
                        const char* name) {
    return gpu::Texture(
        *context_, {.extent = extent, .format = format, .usage = usage, .samples = samples, .name = name});
  };
  const bool multisampled = format_.samples != VK_SAMPLE_COUNT_1_BIT;
  color_ = make(format_.color, multisampled ? kDrawnOnly : kPicture, format_.samples, "color");
  resolved_ =
      multisampled ? make(format_.color, kPicture, VK_SAMPLE_COUNT_1_BIT, "color resolved") : gpu::Texture();
  depth_ = make(format_.depth,
                VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                    VK_IMAGE_USAGE_SAMPLED_BIT,
                format_.samples, "depth");
  for (gpu::Texture* texture :
       {&found_, &foundParameters_, &foundFootprint_, &foundFrame_, &places_, &openness_, &moreLight_})
    *texture = gpu::Texture();
  shadows_.clear();
  transmittances_.clear();
}

/// At least as large as that.
void ViewTargets::makeLightDepth(VkExtent2D extent) {
  if (extent.width == 0 || (lightDepth_ && lightDepth_.extent().width >= extent.width &&
                            lightDepth_.extent().height >= extent.height))
    return;
  lightDepth_ = gpu::Texture(
      *context_, {.extent = extent,
                  .format = format_.depth,
                  .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
                  .name = "light depths"});
}

gpu::Texture& ViewTargets::texture(Target target, std::size_t slot) {
  switch (target) {
    case Target::Depth:
      return depth_;
    case Target::Found:
      return found_;
    case Target::FoundParameters:
      return foundParameters_;
    case Target::FoundFootprint:
      return foundFootprint_;
    case Target::FoundFrame:
      return foundFrame_;
    case Target::Places:
      return places_;
    case Target::Shadows:
      return shadows_[slot];
    case Target::Transmittance:
      return transmittances_[slot];
    case Target::Openness:
      return openness_;
    case Target::MoreLight:
      return moreLight_;
    case Target::LightDepth:
      return lightDepth_;
    case Target::Color:
      break;
  }
  return color_;
}

float ViewTargets::guard() const {
  constexpr std::uint32_t kGuard = 2;
  const VkPhysicalDeviceLimits& limits = context_->limits();
  const bool fits = kGuard * extent().width <= limits.maxViewportDimensions[0] &&
                    kGuard * extent().height <= limits.maxViewportDimensions[1];
  return fits ? kGuard : 1;
}

}  // namespace luxo
