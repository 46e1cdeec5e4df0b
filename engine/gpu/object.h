// SPDX-License-Identifier: Apache-2.0
// What the C API spells out per type of object, as overloads: how to destroy it and what debuggers call its
// type.
#pragma once

#include "gpu/vk.h"

namespace luxo::gpu {

#define LUXO_GPU_OBJECT(Type, NAME)                                                                         \
  inline void destroyObject(VkDevice device, Vk##Type object) { vkDestroy##Type(device, object, nullptr); } \
  constexpr VkObjectType objectType(Vk##Type) { return VK_OBJECT_TYPE_##NAME; }

LUXO_GPU_OBJECT(Buffer, BUFFER)
LUXO_GPU_OBJECT(BufferView, BUFFER_VIEW)
LUXO_GPU_OBJECT(Image, IMAGE)
LUXO_GPU_OBJECT(ImageView, IMAGE_VIEW)
LUXO_GPU_OBJECT(Sampler, SAMPLER)
LUXO_GPU_OBJECT(ShaderModule, SHADER_MODULE)
LUXO_GPU_OBJECT(Pipeline, PIPELINE)
LUXO_GPU_OBJECT(PipelineLayout, PIPELINE_LAYOUT)
LUXO_GPU_OBJECT(PipelineCache, PIPELINE_CACHE)
LUXO_GPU_OBJECT(DescriptorSetLayout, DESCRIPTOR_SET_LAYOUT)
LUXO_GPU_OBJECT(DescriptorPool, DESCRIPTOR_POOL)
LUXO_GPU_OBJECT(CommandPool, COMMAND_POOL)
LUXO_GPU_OBJECT(QueryPool, QUERY_POOL)
LUXO_GPU_OBJECT(Semaphore, SEMAPHORE)
LUXO_GPU_OBJECT(RenderPass, RENDER_PASS)
LUXO_GPU_OBJECT(Framebuffer, FRAMEBUFFER)
LUXO_GPU_OBJECT(SwapchainKHR, SWAPCHAIN_KHR)

#undef LUXO_GPU_OBJECT

}  // namespace luxo::gpu
