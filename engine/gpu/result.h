// SPDX-License-Identifier: Apache-2.0
// Vulkan results as luxo errors.
#pragma once

#include "gpu/vk.h"

#include <string_view>

namespace luxo::gpu {

/// "VK_ERROR_DEVICE_LOST"; for a number that has no name here "VK_RESULT_UNKNOWN".
[[nodiscard]] const char* resultName(VkResult result) noexcept;

/// Throws luxo::Error. Device lost and out of memory are ErrorKind::Retry, no or unfit driver is Device,
/// anything else Internal.
[[noreturn]] void throwResult(VkResult result, std::string_view attempted);

/// Returns for every success code (VK_SUCCESS, VK_TIMEOUT, VK_SUBOPTIMAL_KHR, ...), throws for every failure.
/// `attempted` completes the sentence "cannot ...": "create a buffer of 4 GiB".
inline void check(VkResult result, std::string_view attempted) {
  if (result < 0) throwResult(result, attempted);
}

}  // namespace luxo::gpu
