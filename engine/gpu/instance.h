// SPDX-License-Identifier: Apache-2.0
// The connection to the Vulkan loader. Used by this folder only.
#pragma once

#include "gpu/validation.h"
#include "gpu/vk.h"

#include <memory>
#include <vector>

namespace luxo::gpu {

struct DestroyInstance {
  void operator()(VkInstance instance) const { vkDestroyInstance(instance, nullptr); }
};
/// Null when the loader finds no driver at all.
using Instance = std::unique_ptr<VkInstance_T, DestroyInstance>;

struct DestroyMessenger {
  VkInstance instance = VK_NULL_HANDLE;
  void operator()(VkDebugUtilsMessengerEXT messenger) const;
};
using Messenger = std::unique_ptr<VkDebugUtilsMessengerEXT_T, DestroyMessenger>;

struct InstanceDesc {
  std::vector<const char*> extensions;
  /// Not null: loads the validation layer, which reports there for as long as the instance lives.
  ValidationLog* validation = nullptr;
};

/// Throws Error(Device) when the validation layer or an extension is not installed.
[[nodiscard]] Instance createInstance(const InstanceDesc& desc);

/// Reports to `log` while it lives. Requires an instance with VK_EXT_debug_utils.
[[nodiscard]] Messenger listen(VkInstance instance, ValidationLog& log);

[[nodiscard]] bool hasInstanceExtension(const char* name);

}  // namespace luxo::gpu
