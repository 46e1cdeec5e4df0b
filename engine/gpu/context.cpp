// SPDX-License-Identifier: Apache-2.0
#include "gpu/context.h"

#include "base/assert.h"
#include "base/error.h"
#include "gpu/address_space.h"
#include "gpu/pipeline_cache.h"
#include "gpu/result.h"
#include "gpu/transfer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace luxo::gpu {
namespace {

std::string wantedDevice(const ContextDesc& desc) {
  const char* variable = std::getenv("LUXO_DEVICE");
  const bool replaced = desc.device == "auto" && variable != nullptr && *variable != '\0';
  return replaced ? variable : desc.device;
}

bool hasTimestamps(const Adapter& adapter) {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(adapter.device, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(adapter.device, &count, families.data());
  return families[adapter.queueFamily].timestampValidBits == 64 &&
         adapter.properties.limits.timestampPeriod > 0;
}

Features featuresOf(const Adapter& adapter) {
  VkPhysicalDeviceFeatures supported;
  vkGetPhysicalDeviceFeatures(adapter.device, &supported);
  return {.fillModeNonSolid = supported.fillModeNonSolid == VK_TRUE,
          .independentBlend = supported.independentBlend == VK_TRUE,
          .depthClamp = supported.depthClamp == VK_TRUE,
          .float64 = supported.shaderFloat64 == VK_TRUE,
          .dualSrcBlend = supported.dualSrcBlend == VK_TRUE,
          .logicOp = supported.logicOp == VK_TRUE,
          .geometryShader = supported.geometryShader == VK_TRUE,
          .timestamps = hasTimestamps(adapter)};
}

}  // namespace

Context::Context(const ContextDesc& desc)
    : log_(desc.validationLog ? desc.validationLog : std::make_shared<ValidationLog>()),
      mapDeviceMemory_(desc.mapDeviceMemory) {
  startVulkan(desc);
  adapter_ = chooseAdapter(desc);
  features_ = featuresOf(adapter_);
  // Now that the loader has read the drivers, which for some are a large part of what they need.
  if (const std::uint64_t left = addressSpaceLeft(); left < kDriverBytes)
    throw Error(ErrorKind::Retry,
                fmt::format("cannot start Vulkan: a memory limit leaves {} MiB, and drivers need {}",
                            left >> 20, kDriverBytes >> 20),
                "allow more memory (ulimit -v)");
  createDevice(static_cast<bool>(desc.canPresent));
  memory_ = std::make_unique<Memory>(adapter_.device, device_.get());
  pipelineCache_ = std::make_unique<PipelineCache>(device_.get(), adapter_.properties, cacheDirectory());
  timeline_ = std::make_unique<Timeline>(device_.get(), queue_, adapter_.info.type == DeviceType::Cpu);
  uploads_ = std::make_unique<Uploads>(*this);
}

Context::~Context() {
  uploads_.reset();
  if (timeline_->standsStill()) {
    abandon();
    return;
  }
  vkDeviceWaitIdle(device_.get());  // a lost device has nothing left to wait for
  timeline_->destruction().drain();
  // Whatever is left would be destroyed through a context that is gone.
  LUXO_REQUIRE_COMPARE(counters_.objects, ==, 0u);
}

// The process is about to end, and every way to clean up would wait for ever.
void Context::abandon() {
  static_cast<void>(timeline_.release());
  static_cast<void>(pipelineCache_.release());
  static_cast<void>(memory_.release());
  static_cast<void>(device_.release());
  static_cast<void>(messenger_.release());
  static_cast<void>(instance_.release());
}

void Context::startVulkan(const ContextDesc& desc) {
  InstanceDesc instance{.extensions = desc.instanceExtensions,
                        .validation = desc.validation ? log_.get() : nullptr};
  const bool debugUtils = hasInstanceExtension(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
  if (debugUtils) instance.extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
  instance_ = createInstance(instance);
  if (!instance_ || !debugUtils) return;

  const auto load = [this](const char* name) { return vkGetInstanceProcAddr(instance_.get(), name); };
  nameObject_ = reinterpret_cast<PFN_vkSetDebugUtilsObjectNameEXT>(load("vkSetDebugUtilsObjectNameEXT"));
  beginLabel_ = reinterpret_cast<PFN_vkCmdBeginDebugUtilsLabelEXT>(load("vkCmdBeginDebugUtilsLabelEXT"));
  endLabel_ = reinterpret_cast<PFN_vkCmdEndDebugUtilsLabelEXT>(load("vkCmdEndDebugUtilsLabelEXT"));
  if (desc.validation) messenger_ = listen(instance_.get(), *log_);
}

Adapter Context::chooseAdapter(const ContextDesc& desc) const {
  std::vector<Adapter> adapters = findAdapters(instance_.get(), desc.canPresent);
  std::vector<DeviceInfo> infos;
  for (const Adapter& adapter : adapters) infos.push_back(adapter.info);
  return std::move(adapters[chooseDevice(infos, wantedDevice(desc))]);
}

void Context::createDevice(bool presents) {
  VkPhysicalDeviceVulkan13Features features13{
      .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES,
      .synchronization2 = VK_TRUE,
      .dynamicRendering = VK_TRUE,
      .maintenance4 = VK_TRUE};  // compute shaders as glslang writes them
  VkPhysicalDeviceVulkan12Features features12{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES,
                                              .pNext = &features13,
                                              .scalarBlockLayout = VK_TRUE,
                                              .hostQueryReset = VK_TRUE,
                                              .timelineSemaphore = VK_TRUE};
  const VkPhysicalDeviceFeatures2 features{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2,
                                           .pNext = &features12,
                                           .features = {.independentBlend = features_.independentBlend,
                                                        .geometryShader = features_.geometryShader,
                                                        .sampleRateShading = VK_TRUE,
                                                        .dualSrcBlend = features_.dualSrcBlend,
                                                        .logicOp = features_.logicOp,
                                                        .depthClamp = features_.depthClamp,
                                                        .fillModeNonSolid = features_.fillModeNonSolid,
                                                        .fragmentStoresAndAtomics = VK_TRUE,
                                                        .shaderFloat64 = features_.float64}};
  const float priority = 1;
  const VkDeviceQueueCreateInfo queue{.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                      .queueFamilyIndex = adapter_.queueFamily,
                                      .queueCount = 1,
                                      .pQueuePriorities = &priority};
  const char* swapchain = VK_KHR_SWAPCHAIN_EXTENSION_NAME;
  const VkDeviceCreateInfo info{.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                .pNext = &features,
                                .queueCreateInfoCount = 1,
                                .pQueueCreateInfos = &queue,
                                .enabledExtensionCount = presents ? 1u : 0u,
                                .ppEnabledExtensionNames = &swapchain};
  VkDevice device = VK_NULL_HANDLE;
  check(vkCreateDevice(adapter_.device, &info, nullptr, &device),
        fmt::format("open the Vulkan device {}", adapter_.info.name));
  device_.reset(device);
  vkGetDeviceQueue(device, adapter_.queueFamily, 0, &queue_);
}

VkSampleCountFlagBits Context::supportedSamples(std::uint32_t wanted) const noexcept {
  const VkSampleCountFlags supported =
      limits().framebufferColorSampleCounts & limits().framebufferDepthSampleCounts;
  std::uint32_t best = VK_SAMPLE_COUNT_1_BIT;
  for (std::uint32_t count = 2; count <= std::min<std::uint32_t>(wanted, VK_SAMPLE_COUNT_64_BIT);
       count *= 2) {
    if ((supported & count) != 0) best = count;
  }
  return static_cast<VkSampleCountFlagBits>(best);
}

Counters Context::counters() const {
  Counters result = counters_;
  result.allocations = memory_->allocations();
  result.memoryBytes = memory_->usedBytes();
  result.deviceAllocations = memory_->blocks();
  result.deviceBytes = memory_->reservedBytes();
  result.submits = timeline_->submitted();
  return result;
}

void Context::waitIdle() {
  timeline_->wait(timeline_->submitted());  // bounded, as vkDeviceWaitIdle() is not
  check(vkDeviceWaitIdle(device_.get()), "wait for the device to be idle");
  timeline_->collect();
}

VkPipelineCache Context::pipelineCache() const noexcept { return *pipelineCache_; }

void Context::setName(VkObjectType type, std::uint64_t object, std::string_view name) const {
  if (nameObject_ == nullptr || name.empty()) return;
  const std::string text(name);
  const VkDebugUtilsObjectNameInfoEXT info{.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT,
                                           .objectType = type,
                                           .objectHandle = object,
                                           .pObjectName = text.c_str()};
  check(nameObject_(device_.get(), &info), "name an object");
}

void Context::beginLabel(VkCommandBuffer commands, std::string_view name) const {
  if (beginLabel_ == nullptr) return;
  const std::string text(name);
  const VkDebugUtilsLabelEXT label{.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT,
                                   .pLabelName = text.c_str()};
  beginLabel_(commands, &label);
}

void Context::endLabel(VkCommandBuffer commands) const {
  if (endLabel_ != nullptr) endLabel_(commands);
}

}  // namespace luxo::gpu
