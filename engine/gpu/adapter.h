// SPDX-License-Identifier: Apache-2.0
// Physical devices and what luxo requires of them. Used by this folder only.
#pragma once

#include "gpu/device.h"
#include "gpu/vk.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace luxo::gpu {

using CanPresent = std::function<bool(VkInstance, VkPhysicalDevice, std::uint32_t queueFamily)>;

struct Adapter {
  VkPhysicalDevice device = VK_NULL_HANDLE;
  VkPhysicalDeviceProperties properties{};
  std::uint32_t queueFamily = 0;  ///< graphics and compute, and presenting when asked for
  DeviceInfo info;
};

/// All of them in the loader's order; none for a null instance. `canPresent` may be empty: no window.
[[nodiscard]] std::vector<Adapter> findAdapters(VkInstance instance, const CanPresent& canPresent);

}  // namespace luxo::gpu
