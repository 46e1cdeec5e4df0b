// SPDX-License-Identifier: Apache-2.0
// Which Vulkan devices this machine has, which of them luxo can use, and which one is meant by a name.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace luxo::gpu {

enum class DeviceType { Discrete, Integrated, Virtual, Cpu, Other };

/// "discrete GPU", "CPU", ...
[[nodiscard]] const char* deviceTypeName(DeviceType type) noexcept;

/// A Vulkan device as people see it.
struct DeviceInfo {
  std::string name;  ///< "llvmpipe (LLVM 15.0.6, 256 bits)"
  DeviceType type = DeviceType::Other;
  std::string driver;      ///< name and version: "llvmpipe Mesa 22.3.6 (LLVM 15.0.6)"
  std::string apiVersion;  ///< "1.3.230"
  std::string missing;     ///< the first requirement it does not meet; empty = luxo can use it

  [[nodiscard]] bool usable() const noexcept { return missing.empty(); }
};

/// What vertices hand to fragments, 32 bits each: a device has to have room for so many. Vulkan promises 64,
/// devices have 124 or more.
inline constexpr std::uint32_t kVaryingComponents = 120;
/// Storage buffers that a stage of one pipeline reads at most (SceneLayouts): Vulkan promises 4, devices have
/// 64 or more.
inline constexpr std::uint32_t kStageStorageBuffers = 27;
/// What a fragment may write to, storage buffers and colours together: Vulkan promises 4, GPUs have 8 or
/// more. As Vulkan has it (VUID-RuntimeSpirv-Location-06428), buffers that are only read do not count.
inline constexpr std::uint32_t kFragmentOutputs = 6;
/// Of the raster's grid, as shells reach beyond their surfaces by what corners move on it (raster_slack.h).
/// Vulkan promises 4, devices have 8.
inline constexpr std::uint32_t kSubpixelBits = 8;

/// Every device in the driver's order, which is what a device number counts. Starts and stops Vulkan (about
/// 20 ms); empty when no driver works, and then noDriverHint() says what to try.
[[nodiscard]] std::vector<DeviceInfo> listDevices();

/// The index of the device meant by `wanted`:
/// `auto` the best usable one (discrete, then integrated, virtual, CPU), `gpu` the same without CPUs, `cpu`,
/// a number, or a part of a name in any case. Equals resolve to the first. Pure but for the hint of an empty
/// list. Throws Error(Device) that lists every device with the reason why it was not taken.
[[nodiscard]] std::size_t chooseDevice(std::span<const DeviceInfo> devices, std::string_view wanted);

/// What to try on a machine where Vulkan finds no device; looks at VK_DRIVER_FILES and VK_ICD_FILENAMES.
[[nodiscard]] std::string noDriverHint();

}  // namespace luxo::gpu
