// SPDX-License-Identifier: Apache-2.0
// Descriptors: which buffers and textures a shader sees. Layouts are fixed; sets are written anew every
// frame.
#pragma once

#include "gpu/buffer.h"
#include "gpu/handle.h"
#include "gpu/texture.h"
#include "gpu/vk.h"

#include <functional>
#include <initializer_list>
#include <vector>

namespace luxo::gpu {

/// One binding; its number is its place in the list.
struct DescriptorBinding {
  VkDescriptorType type = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
  VkShaderStageFlags stages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;
};

class DescriptorLayout {
 public:
  DescriptorLayout() = default;
  DescriptorLayout(Context& context, std::vector<DescriptorBinding> bindings);

  operator VkDescriptorSetLayout() const noexcept { return layout_; }
  [[nodiscard]] const std::vector<DescriptorBinding>& bindings() const noexcept { return bindings_; }

 private:
  std::vector<DescriptorBinding> bindings_;
  Handle<VkDescriptorSetLayout> layout_;
};

/// Of the sets of a pipeline, in the order of their numbers.
using SetLayouts = std::vector<std::reference_wrapper<const DescriptorLayout>>;

/// What one binding refers to: a whole buffer, a part of one (`range` bytes at `offset`; for a dynamic
/// offset, the bytes seen from that offset), a buffer's texels, or a texture with its sampler.
struct DescriptorValue {
  DescriptorValue(const Buffer& whole) : buffer{whole, 0, VK_WHOLE_SIZE} {}
  DescriptorValue(const Buffer& part, VkDeviceSize offset, VkDeviceSize range)
      : buffer{part, offset, range} {}
  DescriptorValue(const Texture& texture, VkSampler sampler)
      : image{sampler, texture.view(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL} {}

  DescriptorValue(VkBufferView view) : texels(view) {}

  VkDescriptorBufferInfo buffer{};
  VkBufferView texels = VK_NULL_HANDLE;
  VkDescriptorImageInfo image{};
};

/// Sets that live until reset(). Grows by whole pools and keeps them.
class DescriptorArena {
 public:
  explicit DescriptorArena(Context& context) : context_(&context) {}

  /// A set with a value for every binding of `layout`, in order.
  [[nodiscard]] VkDescriptorSet write(const DescriptorLayout& layout,
                                      std::initializer_list<DescriptorValue> values);

  /// Forgets all sets. No submission in flight may use them.
  void reset();

 private:
  [[nodiscard]] VkDescriptorSet allocate(const DescriptorLayout& layout);
  void addPool();

  Context* context_;
  std::vector<Handle<VkDescriptorPool>> pools_;
  std::size_t pool_ = 0;  // the one that sets come from now
};

}  // namespace luxo::gpu
