// SPDX-License-Identifier: Apache-2.0
#include "gpu/descriptor.h"

#include "base/assert.h"
#include "gpu/result.h"

#include <array>
#include <cstdint>
#include <utility>

namespace luxo::gpu {
namespace {

constexpr std::uint32_t kSetsPerPool = 64;

}  // namespace

DescriptorLayout::DescriptorLayout(Context& context, std::vector<DescriptorBinding> bindings)
    : bindings_(std::move(bindings)) {
  std::vector<VkDescriptorSetLayoutBinding> infos;
  for (const DescriptorBinding& binding : bindings_) {
    infos.push_back({.binding = static_cast<std::uint32_t>(infos.size()),
                     .descriptorType = binding.type,
                     .descriptorCount = 1,
                     .stageFlags = binding.stages});
  }
  const VkDescriptorSetLayoutCreateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                                             .bindingCount = static_cast<std::uint32_t>(infos.size()),
                                             .pBindings = infos.data()};
  VkDescriptorSetLayout layout = VK_NULL_HANDLE;
  check(vkCreateDescriptorSetLayout(context.device(), &info, nullptr, &layout), "create a descriptor layout");
  layout_ = {context, layout};
}

VkDescriptorSet DescriptorArena::write(const DescriptorLayout& layout,
                                       std::initializer_list<DescriptorValue> values) {
  LUXO_REQUIRE_COMPARE(values.size(), ==, layout.bindings().size());
  const VkDescriptorSet set = allocate(layout);
  std::vector<VkWriteDescriptorSet> writes;
  for (const DescriptorValue& value : values) {
    const std::size_t binding = writes.size();
    const DescriptorBinding& described = layout.bindings()[binding];
    const bool sampled = described.type == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    const bool texels = described.type == VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
    LUXO_REQUIRE(texels    ? value.texels != VK_NULL_HANDLE
                 : sampled ? value.image.imageView != VK_NULL_HANDLE
                           : value.buffer.buffer != VK_NULL_HANDLE);
    writes.push_back({.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                      .dstSet = set,
                      .dstBinding = static_cast<std::uint32_t>(binding),
                      .descriptorCount = 1,
                      .descriptorType = described.type,
                      .pImageInfo = &value.image,
                      .pBufferInfo = &value.buffer,
                      .pTexelBufferView = &value.texels});
  }
  vkUpdateDescriptorSets(context_->device(), static_cast<std::uint32_t>(writes.size()), writes.data(), 0,
                         nullptr);
  return set;
}

VkDescriptorSet DescriptorArena::allocate(const DescriptorLayout& layout) {
  const VkDescriptorSetLayout raw = layout;
  for (;; ++pool_) {
    const bool fresh = pool_ == pools_.size();
    if (fresh) addPool();
    const VkDescriptorSetAllocateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                           .descriptorPool = pools_[pool_],
                                           .descriptorSetCount = 1,
                                           .pSetLayouts = &raw};
    VkDescriptorSet set = VK_NULL_HANDLE;
    const VkResult result = vkAllocateDescriptorSets(context_->device(), &info, &set);
    const bool full = result == VK_ERROR_OUT_OF_POOL_MEMORY || result == VK_ERROR_FRAGMENTED_POOL;
    if (full && !fresh) continue;
    check(result, "allocate a descriptor set");
    return set;
  }
}

void DescriptorArena::addPool() {
  static constexpr std::array kSizes{
      VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 8 * kSetsPerPool},
      VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 2 * kSetsPerPool},
      VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC, 2 * kSetsPerPool},
      VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 2 * kSetsPerPool},
      VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, kSetsPerPool}};
  const VkDescriptorPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                        .maxSets = kSetsPerPool,
                                        .poolSizeCount = kSizes.size(),
                                        .pPoolSizes = kSizes.data()};
  VkDescriptorPool pool = VK_NULL_HANDLE;
  check(vkCreateDescriptorPool(context_->device(), &info, nullptr, &pool), "create a descriptor pool");
  pools_.emplace_back(*context_, pool);
}

void DescriptorArena::reset() {
  for (const auto& pool : pools_) {
    check(vkResetDescriptorPool(context_->device(), pool, 0), "reset a descriptor pool");
  }
  pool_ = 0;
}

}  // namespace luxo::gpu
