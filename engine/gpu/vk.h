// SPDX-License-Identifier: Apache-2.0
// The one place that includes Vulkan. Functions come from the loader (libvulkan), extensions from
// gpu/debug.h.
#pragma once

#include <vulkan/vulkan.h>

static_assert(VK_USE_64_BIT_PTR_DEFINES, "luxo tells Vulkan handles apart by their type: 64-bit only");
