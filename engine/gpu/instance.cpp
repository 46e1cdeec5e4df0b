// SPDX-License-Identifier: Apache-2.0
#include "gpu/instance.h"

#include "base/error.h"
#include "gpu/result.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <mutex>
#include <string_view>

namespace luxo::gpu {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

bool hasLayer(std::string_view name) {
  std::uint32_t count = 0;
  check(vkEnumerateInstanceLayerProperties(&count, nullptr), "list Vulkan layers");
  std::vector<VkLayerProperties> layers(count);
  check(vkEnumerateInstanceLayerProperties(&count, layers.data()), "list Vulkan layers");
  return std::ranges::any_of(layers, [&](const VkLayerProperties& layer) { return layer.layerName == name; });
}

/// How the loader says that it found no driver; and that a file which should name one cannot be read as that,
/// although it calls this, among others, a lack of memory.
bool foundNoDriver(VkResult result) {
  if (result == VK_ERROR_INCOMPATIBLE_DRIVER) return true;
  const bool named =
      std::ranges::any_of(std::array{"VK_DRIVER_FILES", "VK_ICD_FILENAMES"}, [](const char* v) {
        const char* value = std::getenv(v);
        return value != nullptr && *value != '\0';
      });
  return named && (result == VK_ERROR_OUT_OF_HOST_MEMORY || result == VK_ERROR_INITIALIZATION_FAILED);
}

constexpr VkApplicationInfo kApplication{.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                         .pApplicationName = "luxo",
                                         .pEngineName = "luxo",
                                         .apiVersion = VK_API_VERSION_1_3};

/// From a process's second instance on its drivers stay loaded, by an instance that nobody ends. A driver
/// that is loaded anew takes 7 ms, and memory of thread-local variables that glibc does not give back:
/// NVIDIA's (580) can be loaded 26 times.
void keepDriversLoaded() {
  static std::mutex mutex;
  static bool second = false;
  static VkInstance kept = VK_NULL_HANDLE;
  const std::scoped_lock lock(mutex);
  const VkInstanceCreateInfo info{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                  .pApplicationInfo = &kApplication};
  if (second && kept == VK_NULL_HANDLE) vkCreateInstance(&info, nullptr, &kept);  // else the next one tries
  second = true;
}

}  // namespace

bool hasInstanceExtension(const char* name) {
  std::uint32_t count = 0;
  const VkResult result = vkEnumerateInstanceExtensionProperties(nullptr, &count, nullptr);
  if (foundNoDriver(result)) return false;
  check(result, "list Vulkan extensions");
  std::vector<VkExtensionProperties> extensions(count);
  check(vkEnumerateInstanceExtensionProperties(nullptr, &count, extensions.data()), "list Vulkan extensions");
  return std::ranges::any_of(extensions, [&](const VkExtensionProperties& extension) {
    return std::string_view(extension.extensionName) == name;
  });
}

Instance createInstance(const InstanceDesc& desc) {
  if (desc.validation != nullptr && !hasLayer(kValidationLayer)) {
    throw Error(ErrorKind::Device, "cannot validate: the Vulkan validation layer is not installed",
                "apt install vulkan-validationlayers");
  }
  static constexpr std::array kChecks{VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
  // Chained to the instance, the messenger also hears of its creation and destruction.
  VkDebugUtilsMessengerCreateInfoEXT messenger{};
  if (desc.validation != nullptr) messenger = messengerInfo(*desc.validation);
  const VkValidationFeaturesEXT checks{.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT,
                                       .pNext = &messenger,
                                       .enabledValidationFeatureCount = kChecks.size(),
                                       .pEnabledValidationFeatures = kChecks.data()};
  keepDriversLoaded();
  const bool validates = desc.validation != nullptr;
  const VkInstanceCreateInfo info{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                  .pNext = validates ? &checks : nullptr,
                                  .pApplicationInfo = &kApplication,
                                  .enabledLayerCount = validates ? 1u : 0u,
                                  .ppEnabledLayerNames = &kValidationLayer,
                                  .enabledExtensionCount = static_cast<std::uint32_t>(desc.extensions.size()),
                                  .ppEnabledExtensionNames = desc.extensions.data()};
  VkInstance instance = VK_NULL_HANDLE;
  const VkResult result = vkCreateInstance(&info, nullptr, &instance);
  if (foundNoDriver(result)) return nullptr;
  check(result, "start Vulkan");
  return Instance(instance);
}

void DestroyMessenger::operator()(VkDebugUtilsMessengerEXT messenger) const {
  const auto destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
      vkGetInstanceProcAddr(instance, "vkDestroyDebugUtilsMessengerEXT"));
  destroy(instance, messenger, nullptr);
}

Messenger listen(VkInstance instance, ValidationLog& log) {
  const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
      vkGetInstanceProcAddr(instance, "vkCreateDebugUtilsMessengerEXT"));
  const VkDebugUtilsMessengerCreateInfoEXT info = messengerInfo(log);
  VkDebugUtilsMessengerEXT messenger = VK_NULL_HANDLE;
  check(create(instance, &info, nullptr, &messenger), "listen to the validation layer");
  return Messenger(messenger, DestroyMessenger{instance});
}

}  // namespace luxo::gpu
