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
  constexpr VkImageUsageFlags kPicture =
      VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
  constexpr VkImageUsageFlags kDrawnOnly = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
  constexpr VkImageUsageFlags kReadAgain = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
  const auto make = [&](VkFormat format, VkImageUsageFlags usage, VkSampleCountFlagBits of,
                        const char* name) {
    return gpu::Texture(*context_,
                        {.extent = extent, .format = format, .usage = usage, .samples = of, .name = name});
  };
  format_.samples = samples;
  if (!fits(color_, extent, samples)) {
    const bool multisampled = samples != VK_SAMPLE_COUNT_1_BIT;
    color_ = make(format_.color, multisampled ? kDrawnOnly : kPicture, samples, "color");
    resolved_ = multisampled ? make(format_.color, kPicture, VK_SAMPLE_COUNT_1_BIT, "color resolved")
                             : gpu::Texture();
    depth_ = make(format_.depth,
                  VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                      VK_IMAGE_USAGE_SAMPLED_BIT,
                  samples, "depth");
    found_ = gpu::Texture();
    foundParameters_ = gpu::Texture();
    foundFootprint_ = gpu::Texture();
    foundFrame_ = gpu::Texture();
    places_ = gpu::Texture();
    shadows_.clear();
    transmittances_.clear();
    openness_ = gpu::Texture();
    moreLight_ = gpu::Texture();
  }
  if (const VkExtent2D wanted = needs.lightDepth;
      wanted.width > 0 && !(lightDepth_ && lightDepth_.extent().width >= wanted.width &&
                            lightDepth_.extent().height >= wanted.height))
    lightDepth_ = gpu::Texture(
        *context_, {.extent = wanted,
                    .format = format_.depth,
                    .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
                    .name = "light depths"});
  const auto makeSlots = [&](std::vector<gpu::Texture>& textures, std::uint32_t wanted, VkFormat format,
                             const char* name) {
    textures.resize(std::max<std::size_t>(textures.size(), std::bit_width(wanted)));
    for (std::size_t slot = 0; slot < textures.size(); ++slot)
      if ((wanted >> slot & 1) != 0 && !fits(textures[slot], extent, VK_SAMPLE_COUNT_1_BIT))
        textures[slot] = make(format, kReadAgain | VK_IMAGE_USAGE_TRANSFER_SRC_BIT, samples, name);
  };
  makeSlots(shadows_, needs.shadows, kShadowsFormat, "shadows");
  makeSlots(transmittances_, needs.transmittances, kTransmittanceFormat, "transmittance");
  if (needs.openness && !fits(openness_, extent, VK_SAMPLE_COUNT_1_BIT))
    openness_ = make(kOpennessFormat, kReadAgain, samples, "openness");
  if (needs.moreLight && !fits(moreLight_, extent, VK_SAMPLE_COUNT_1_BIT))
    moreLight_ = make(format_.color, kReadAgain, samples, "light of more lights");
  if (needs.shadows != 0 && (!places_ || (needs.places && !fits(places_, extent, VK_SAMPLE_COUNT_1_BIT))))
    places_ = gpu::Texture(*context_, {.extent = needs.places ? extent : VkExtent2D{1, 1},
                                       .format = kPlacesFormat,
                                       .usage = kReadAgain,
                                       .name = "places of meshes"});
  if (needs.footprints && !fits(foundFootprint_, extent, VK_SAMPLE_COUNT_1_BIT))
    foundFootprint_ = make(kFoundFootprintFormat, kReadAgain, samples, "footprints of what is found");
  if (needs.frames && !fits(foundFrame_, extent, VK_SAMPLE_COUNT_1_BIT))
    foundFrame_ = make(kFoundFrameFormat, kReadAgain, samples, "frames of what is found");
  if (!needs.deferred || fits(found_, extent, VK_SAMPLE_COUNT_1_BIT)) return;
  LUXO_REQUIRE_COMPARE(samples, ==, VK_SAMPLE_COUNT_1_BIT);
  found_ = make(kFoundFormat, kReadAgain, samples, "found");
  foundParameters_ = make(kFoundParametersFormat, kReadAgain, samples, "parameters of what is found");
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
