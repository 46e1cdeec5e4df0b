// SPDX-License-Identifier: Apache-2.0
#include "gpu/adapter.h"

#include "gpu/result.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>

namespace luxo::gpu {
namespace {

std::string versionText(std::uint32_t version) {
  return fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version),
                     VK_API_VERSION_PATCH(version));
}

DeviceType typeOf(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return DeviceType::Discrete;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return DeviceType::Integrated;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return DeviceType::Virtual;
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return DeviceType::Cpu;
    default:
      return DeviceType::Other;
  }
}

std::optional<std::uint32_t> findQueueFamily(VkInstance instance, VkPhysicalDevice device,
                                             const CanPresent& canPresent) {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
  constexpr VkQueueFlags kNeeded = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
  for (std::uint32_t family = 0; family < count; ++family) {
    if ((families[family].queueFlags & kNeeded) != kNeeded) continue;
    if (!canPresent || canPresent(instance, device, family)) return family;
  }
  return std::nullopt;
}

bool hasExtension(VkPhysicalDevice device, std::string_view name) {
  std::uint32_t count = 0;
  check(vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr), "list device extensions");
  std::vector<VkExtensionProperties> extensions(count);
  check(vkEnumerateDeviceExtensionProperties(device, nullptr, &count, extensions.data()),
        "list device extensions");
  return std::ranges::any_of(
      extensions, [&](const VkExtensionProperties& extension) { return extension.extensionName == name; });
}

std::string missingFeature(VkPhysicalDevice device) {
  VkPhysicalDeviceVulkan13Features features13{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
  VkPhysicalDeviceVulkan12Features features12{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES,
                                              .pNext = &features13};
  VkPhysicalDeviceFeatures2 features{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2,
                                     .pNext = &features12};
  vkGetPhysicalDeviceFeatures2(device, &features);
  const std::pair<VkBool32, const char*> required[] = {
      {features.features.sampleRateShading, "sampleRateShading"},
      {features.features.fragmentStoresAndAtomics, "fragmentStoresAndAtomics"},
      {features13.dynamicRendering, "dynamicRendering"},
      {features13.synchronization2, "synchronization2"},
      {features13.maintenance4, "maintenance4"},
      {features12.timelineSemaphore, "timelineSemaphore"},
      {features12.scalarBlockLayout, "scalarBlockLayout"},
      {features12.hostQueryReset, "hostQueryReset"}};
  for (const auto& [present, name] : required) {
    if (!present) return fmt::format("it lacks the feature {}", name);
  }
  return {};
}

std::string tooLow(const VkPhysicalDeviceLimits& limits) {
  struct Needed {
    std::uint32_t limit, least;
    const char* name;
  };
  const Needed needed[] = {
      {limits.maxVertexOutputComponents, kVaryingComponents, "maxVertexOutputComponents"},
      {limits.maxFragmentInputComponents, kVaryingComponents, "maxFragmentInputComponents"},
      {limits.maxPerStageDescriptorStorageBuffers, kStageStorageBuffers,
       "maxPerStageDescriptorStorageBuffers"},
      {limits.maxDescriptorSetStorageBuffers, kStageStorageBuffers, "maxDescriptorSetStorageBuffers"},
      {limits.maxFragmentCombinedOutputResources, kFragmentOutputs, "maxFragmentCombinedOutputResources"},
      {limits.subPixelPrecisionBits, kSubpixelBits, "subPixelPrecisionBits"}};
  for (const auto& [limit, least, name] : needed)
    if (limit < least) return fmt::format("its limit {} is {}, below {}", name, limit, least);
  return {};
}

std::string missingFormat(VkPhysicalDevice device) {
  constexpr VkFormatFeatureFlags kBlended = VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT;
  constexpr VkFormatFeatureFlags kDepth = VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT;
  struct Required {
    VkFormat format;
    VkFormatFeatureFlags features;
    const char* text;
  };
  constexpr Required kRequired[] = {
      {VK_FORMAT_D32_SFLOAT, kDepth, "32-bit float depth (D32_SFLOAT)"},
      {VK_FORMAT_R16G16B16A16_SFLOAT, kBlended, "blending into R16G16B16A16_SFLOAT"},
      {VK_FORMAT_R32G32B32A32_SFLOAT, kBlended, "blending into R32G32B32A32_SFLOAT"}};
  for (const Required& required : kRequired) {
    VkFormatProperties properties;
    vkGetPhysicalDeviceFormatProperties(device, required.format, &properties);
    if ((properties.optimalTilingFeatures & required.features) != required.features) {
      return fmt::format("it lacks {}", required.text);
    }
  }
  return {};
}

// The first requirement that the adapter does not meet; sets the queue family when there is one.
std::string firstMissing(VkInstance instance, const CanPresent& canPresent, Adapter& adapter) {
  if (adapter.properties.apiVersion < VK_API_VERSION_1_3) return "it lacks Vulkan 1.3";
  const auto family = findQueueFamily(instance, adapter.device, canPresent);
  if (!family) {
    return canPresent ? "it has no graphics and compute queue that can show pictures in this window system"
                      : "it has no queue for graphics and compute";
  }
  adapter.queueFamily = *family;
  if (canPresent && !hasExtension(adapter.device, VK_KHR_SWAPCHAIN_EXTENSION_NAME)) {
    return "it lacks the extension VK_KHR_swapchain";
  }
  std::string missing = missingFeature(adapter.device);
  if (missing.empty()) missing = tooLow(adapter.properties.limits);
  return missing.empty() ? missingFormat(adapter.device) : missing;
}

Adapter adapterOf(VkInstance instance, VkPhysicalDevice device, const CanPresent& canPresent) {
  Adapter adapter{.device = device};
  VkPhysicalDeviceDriverProperties driver{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
  VkPhysicalDeviceProperties2 properties{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2,
                                         .pNext = &driver};
  vkGetPhysicalDeviceProperties2(device, &properties);
  adapter.properties = properties.properties;
  adapter.info = {.name = adapter.properties.deviceName,
                  .type = typeOf(adapter.properties.deviceType),
                  .driver = fmt::format("{} {}", driver.driverName, driver.driverInfo),
                  .apiVersion = versionText(adapter.properties.apiVersion)};
  adapter.info.missing = firstMissing(instance, canPresent, adapter);
  return adapter;
}

}  // namespace

std::vector<Adapter> findAdapters(VkInstance instance, const CanPresent& canPresent) {
  if (instance == VK_NULL_HANDLE) return {};
  std::uint32_t count = 0;
  const VkResult result = vkEnumeratePhysicalDevices(instance, &count, nullptr);
  // A driver that is installed and cannot start here fails like this; it has no devices then.
  if (result == VK_ERROR_INITIALIZATION_FAILED) return {};
  check(result, "list Vulkan devices");
  std::vector<VkPhysicalDevice> devices(count);
  check(vkEnumeratePhysicalDevices(instance, &count, devices.data()), "list Vulkan devices");

  std::vector<Adapter> adapters;
  for (const VkPhysicalDevice device : devices) adapters.push_back(adapterOf(instance, device, canPresent));
  return adapters;
}

}  // namespace luxo::gpu
