// SPDX-License-Identifier: Apache-2.0
// Textures: an image on the device with its view. (The folder `image` holds pictures on the host.)
#pragma once

#include "gpu/handle.h"
#include "gpu/usage.h"
#include "gpu/vk.h"

#include <cstdint>
#include <string_view>

namespace luxo::gpu {

struct TextureDesc {
  VkExtent2D extent{};  ///< pixels
  VkFormat format = VK_FORMAT_UNDEFINED;
  VkImageUsageFlags usage = 0;
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
  std::string_view name;
};

/// Colour or depth.
[[nodiscard]] VkImageAspectFlags aspectOf(VkFormat format) noexcept;
/// Bytes of one texel (one sample) as it is copied to a buffer. Requires one of the formats luxo draws to:
/// 8-bit RGBA and BGRA, 16- and 32-bit float RGBA, 32-bit R float and integer, D32.
[[nodiscard]] std::uint32_t bytesPerTexel(VkFormat format);

/// Two-dimensional, one layer, one level, optimally tiled; undefined until first written.
class Texture {
 public:
  Texture() = default;
  /// Requires an extent from 1x1 to limits().maxImageDimension2D, a format and a usage. Throws Error(Retry)
  /// when memory runs out.
  Texture(Context& context, const TextureDesc& desc);
  Texture(Texture&&) noexcept = default;
  Texture& operator=(Texture&& other) noexcept;

  operator VkImage() const noexcept { return image_; }
  explicit operator bool() const noexcept { return static_cast<bool>(image_); }
  [[nodiscard]] VkImageView view() const noexcept { return view_; }
  [[nodiscard]] VkExtent2D extent() const noexcept { return extent_; }
  [[nodiscard]] VkFormat format() const noexcept { return format_; }
  [[nodiscard]] VkSampleCountFlagBits samples() const noexcept { return samples_; }

  [[nodiscard]] ResourceState& state() noexcept { return state_; }

 private:
  Handle<VkImage> image_;
  Handle<VkImageView> view_;  // dropped before its image
  VkExtent2D extent_{};
  VkFormat format_ = VK_FORMAT_UNDEFINED;
  VkSampleCountFlagBits samples_ = VK_SAMPLE_COUNT_1_BIT;
  ResourceState state_{ResourceKind::Image};
};

/// Clamps at the edges, one level.
[[nodiscard]] Handle<VkSampler> createSampler(Context& context, VkFilter filter);

}  // namespace luxo::gpu
