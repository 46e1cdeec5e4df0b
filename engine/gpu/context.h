// SPDX-License-Identifier: Apache-2.0
// One Vulkan device, ready to draw: the first thing to make and the last to go.
#pragma once

#include "gpu/adapter.h"
#include "gpu/device.h"
#include "gpu/instance.h"
#include "gpu/memory.h"
#include "gpu/timeline.h"
#include "gpu/validation.h"
#include "gpu/vk.h"

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace luxo::gpu {

class PipelineCache;
class Uploads;

struct ContextDesc {
  /// What chooseDevice() understands. The environment's LUXO_DEVICE replaces "auto".
  std::string device = "auto";
  /// Loads the validation layer with synchronization validation; Error(Device) when it is not installed.
  bool validation = false;
  /// Where its messages go; one is made when null. Pass one to read it after the context is gone.
  std::shared_ptr<ValidationLog> validationLog;
  /// What the window system needs, as it names them.
  std::vector<const char*> instanceExtensions;
  /// Set to present: the device must support swapchains and its queue must satisfy this. Empty = no window.
  CanPresent canPresent;
  /// False treats MemoryUse::Device as out of the host's reach everywhere, as it is on most GPUs: every such
  /// write is staged. For tests.
  bool mapDeviceMemory = true;
};

/// What only some devices can; what every device must can is required of it instead.
struct Features {
  bool fillModeNonSolid = false;  ///< lines and points from triangles
  bool independentBlend = false;  ///< blending that differs between the attachments of a pipeline
  bool depthClamp = false;        ///< triangles are drawn that lie before the near plane
  bool float64 = false;           ///< shaders compute in double
  bool dualSrcBlend = false;      ///< Blend::Through
  bool logicOp = false;           ///< Blend::Or
  bool geometryShader = false;    ///< fragments know the number of their triangle
  bool timestamps = false;        ///< FrameRing measures device time
};

/// Live objects and totals since the start.
struct Counters {
  // Live now; dropped ones count until the device is done with them.
  std::uint64_t buffers = 0;
  std::uint64_t textures = 0;
  std::uint64_t objects = 0;      ///< Vulkan objects held by a Handle, those of buffers and textures included
  std::uint64_t allocations = 0;  ///< parts of memory blocks in use
  std::uint64_t memoryBytes = 0;  ///< in those parts
  std::uint64_t deviceAllocations = 0;  ///< memory blocks
  std::uint64_t deviceBytes = 0;        ///< in those blocks
  // Totals.
  std::uint64_t pipelinesCreated = 0;
  double pipelineMs = 0;              ///< in which these were made, by the driver
  std::uint64_t shadersCompiled = 0;  ///< while the program ran; those read from disk do not count
  std::uint64_t submits = 0;
  std::uint64_t uploadedBytes = 0;
};

/// Owns instance, device, one queue for everything, memory and the pipeline cache. Everything made from a
/// context refers to it and must be gone before it (required). Single-threaded: a context and all that is
/// made from it belong to one thread at a time.
class Context {
 public:
  /// Throws Error(Device) when no device fits, naming each device with the reason.
  explicit Context(const ContextDesc& desc = {});
  /// Waits for the device, destroys what was dropped, saves the pipeline cache.
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  [[nodiscard]] const DeviceInfo& deviceInfo() const noexcept { return adapter_.info; }
  [[nodiscard]] const Features& features() const noexcept { return features_; }
  [[nodiscard]] const VkPhysicalDeviceLimits& limits() const noexcept { return adapter_.properties.limits; }
  /// The largest supported count of samples, for colour and depth together, that is at most `wanted`.
  [[nodiscard]] VkSampleCountFlagBits supportedSamples(std::uint32_t wanted) const noexcept;

  [[nodiscard]] Counters counters() const;

  /// Blocks until the device has nothing to do, then destroys what was dropped.
  void waitIdle();

  // The raw objects, for the code that must speak Vulkan itself.
  [[nodiscard]] VkInstance instance() const noexcept { return instance_.get(); }
  [[nodiscard]] VkPhysicalDevice physicalDevice() const noexcept { return adapter_.device; }
  [[nodiscard]] VkDevice device() const noexcept { return device_.get(); }
  [[nodiscard]] VkQueue queue() const noexcept { return queue_; }
  [[nodiscard]] std::uint32_t queueFamily() const noexcept { return adapter_.queueFamily; }
  [[nodiscard]] VkPipelineCache pipelineCache() const noexcept;

  // The parts the rest of this folder builds on.
  [[nodiscard]] Memory& memory() noexcept { return *memory_; }
  [[nodiscard]] Timeline& timeline() noexcept { return *timeline_; }
  [[nodiscard]] Uploads& uploads() noexcept { return *uploads_; }
  [[nodiscard]] Counters& counted() noexcept { return counters_; }
  [[nodiscard]] bool mapsDeviceMemory() const noexcept { return mapDeviceMemory_; }

  // Names for validation messages and debuggers (debug.h has the typed forms); nothing without
  // VK_EXT_debug_utils.
  void setName(VkObjectType type, std::uint64_t object, std::string_view name) const;
  void beginLabel(VkCommandBuffer commands, std::string_view name) const;
  void endLabel(VkCommandBuffer commands) const;

 private:
  struct DestroyDevice {
    void operator()(VkDevice device) const { vkDestroyDevice(device, nullptr); }
  };

  void startVulkan(const ContextDesc& desc);
  [[nodiscard]] Adapter chooseAdapter(const ContextDesc& desc) const;
  void createDevice(bool presents);
  /// Leaves everything as it is, of a device that stands still (gpu/timeline.h).
  void abandon();

  std::shared_ptr<ValidationLog> log_;
  Counters counters_;
  bool mapDeviceMemory_;
  // Destroyed from the last to the first.
  Instance instance_;
  Messenger messenger_;
  Adapter adapter_;
  Features features_;
  std::unique_ptr<VkDevice_T, DestroyDevice> device_;
  VkQueue queue_ = VK_NULL_HANDLE;
  PFN_vkSetDebugUtilsObjectNameEXT nameObject_ = nullptr;
  PFN_vkCmdBeginDebugUtilsLabelEXT beginLabel_ = nullptr;
  PFN_vkCmdEndDebugUtilsLabelEXT endLabel_ = nullptr;
  std::unique_ptr<Memory> memory_;
  std::unique_ptr<PipelineCache> pipelineCache_;
  std::unique_ptr<Timeline> timeline_;
  std::unique_ptr<Uploads> uploads_;
};

}  // namespace luxo::gpu
