// SPDX-License-Identifier: Apache-2.0
#include "gpu/result.h"

#include "base/error.h"

#include <fmt/format.h>

namespace luxo::gpu {

const char* resultName(VkResult result) noexcept {
#define LUXO_GPU_RESULT(name) \
  case name:                  \
    return #name;
  switch (result) {
    LUXO_GPU_RESULT(VK_SUCCESS)
    LUXO_GPU_RESULT(VK_NOT_READY)
    LUXO_GPU_RESULT(VK_TIMEOUT)
    LUXO_GPU_RESULT(VK_EVENT_SET)
    LUXO_GPU_RESULT(VK_EVENT_RESET)
    LUXO_GPU_RESULT(VK_INCOMPLETE)
    LUXO_GPU_RESULT(VK_SUBOPTIMAL_KHR)
    LUXO_GPU_RESULT(VK_PIPELINE_COMPILE_REQUIRED)
    LUXO_GPU_RESULT(VK_ERROR_OUT_OF_HOST_MEMORY)
    LUXO_GPU_RESULT(VK_ERROR_OUT_OF_DEVICE_MEMORY)
    LUXO_GPU_RESULT(VK_ERROR_OUT_OF_POOL_MEMORY)
    LUXO_GPU_RESULT(VK_ERROR_FRAGMENTED_POOL)
    LUXO_GPU_RESULT(VK_ERROR_FRAGMENTATION)
    LUXO_GPU_RESULT(VK_ERROR_UNKNOWN)
    LUXO_GPU_RESULT(VK_ERROR_INITIALIZATION_FAILED)
    LUXO_GPU_RESULT(VK_ERROR_DEVICE_LOST)
    LUXO_GPU_RESULT(VK_ERROR_MEMORY_MAP_FAILED)
    LUXO_GPU_RESULT(VK_ERROR_LAYER_NOT_PRESENT)
    LUXO_GPU_RESULT(VK_ERROR_EXTENSION_NOT_PRESENT)
    LUXO_GPU_RESULT(VK_ERROR_FEATURE_NOT_PRESENT)
    LUXO_GPU_RESULT(VK_ERROR_INCOMPATIBLE_DRIVER)
    LUXO_GPU_RESULT(VK_ERROR_TOO_MANY_OBJECTS)
    LUXO_GPU_RESULT(VK_ERROR_FORMAT_NOT_SUPPORTED)
    LUXO_GPU_RESULT(VK_ERROR_INVALID_SHADER_NV)
    LUXO_GPU_RESULT(VK_ERROR_SURFACE_LOST_KHR)
    LUXO_GPU_RESULT(VK_ERROR_NATIVE_WINDOW_IN_USE_KHR)
    LUXO_GPU_RESULT(VK_ERROR_OUT_OF_DATE_KHR)
    default:
      return "VK_RESULT_UNKNOWN";
  }
#undef LUXO_GPU_RESULT
}

void throwResult(VkResult result, std::string_view attempted) {
  const std::string message =
      fmt::format("cannot {}: Vulkan says {} ({})", attempted, resultName(result), static_cast<int>(result));
  switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
    case VK_ERROR_OUT_OF_POOL_MEMORY:
    case VK_ERROR_TOO_MANY_OBJECTS:
      throw Error(ErrorKind::Retry, message,
                  "use a smaller picture or fewer samples, or close other programs");
    case VK_ERROR_DEVICE_LOST:
      throw Error(
          ErrorKind::Retry, message,
          "the driver reset the device: run again, or choose another device (luxo doctor lists them)");
    case VK_ERROR_UNKNOWN:  // Mesa's, of threads that it cannot start
      throw Error(
          ErrorKind::Retry, message,
          "the driver does not say why: allow more processes (ulimit -u) or memory (ulimit -v), or try "
          "again when more is free");
    case VK_ERROR_INCOMPATIBLE_DRIVER:
    case VK_ERROR_INITIALIZATION_FAILED:
    case VK_ERROR_LAYER_NOT_PRESENT:
    case VK_ERROR_EXTENSION_NOT_PRESENT:
    case VK_ERROR_FEATURE_NOT_PRESENT:
      throw Error(ErrorKind::Device, message, "luxo doctor shows what this machine's drivers can do");
    default:
      throw Error(ErrorKind::Internal, message);
  }
}

}  // namespace luxo::gpu
